// section: 7.3.1
// value: x.y = 2, x.z = 4
model ClassExtends
  model H
    replaceable model T
      Real y = 2;
    end T;
    T x;
  end H;
  extends H;
  redeclare model extends T
    Real z = 2*y;
  end T;
end ClassExtends;
