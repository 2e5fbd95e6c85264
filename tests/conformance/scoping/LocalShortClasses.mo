// section: 4.5.1
// value: w.y = 100, v[2].y = 3, x = 1.8393972058572117, load.y = 7, other.y = 2, u[3] = 3, inner1.l.y = 9, inner2.l.y = 5
model LocalShortClasses "modifications of a short class see what is around it"
  model A
    parameter Real j = 1;
    Real y = j;
  end A;
  partial model Base
    parameter Real R = 7;
    replaceable model Load = A(j=R);
    Load l;
  end Base;
  model Plain
    extends Base;
  end Plain;
  model Other
    extends Base(R=4, redeclare model Load = A(j=R + 1));
  end Other;
  parameter Real k = 100;
  parameter Real start = 5;
  parameter Integer n = 3;
  parameter Real R = 7;
  model C = A(j=k);
  type T = Real(start=start, fixed=true);
  type V = Real[n];
  replaceable model Load = A(j=R);
  C w;
  C v[2](each j=3);
  T x;
  V u = {1, 2, 3};
  Load load;
  Load other(j=2);
  Plain inner1(R=9);
  model Late
    extends Base(R=4);
  end Late;
  Other inner2;
equation
  der(x) = -x;
end LocalShortClasses;
