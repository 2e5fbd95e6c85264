// section: 7.3.1
// value: x.y = 3
model ClassExtendsModified
  model H
    replaceable model T
      parameter Real k = 1;
      Real y = k;
    end T;
    T x;
  end H;
  extends H;
  redeclare model extends T(k=3)
  end T;
end ClassExtendsModified;
