// section: 7.3
// value: u.y[3] = 1
model TypeOfOtherSize
  type T = Real;
  type V3 = Real[3];
  model U
    replaceable type T = Real[2];
    T y = fill(1, size(y, 1));
  end U;
  U u(redeclare type T = V3);
end TypeOfOtherSize;
