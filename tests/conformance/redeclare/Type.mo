// section: 7.3
// value: h.size = 3
model Type
  model H
    replaceable type T = Real[2];
    T x = fill(time, size(x, 1));
    Integer size = 3;
  end H;
  H h;
end Type;
