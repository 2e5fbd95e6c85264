// section: 7.3
// value: x.y = 7
model ElementOfExtends
  model H
    replaceable model T
      Real y = 2;
    end T;
    T x;
  end H;
  extends H;
  redeclare model T
    Real y = 7;
  end T;
end ElementOfExtends;
