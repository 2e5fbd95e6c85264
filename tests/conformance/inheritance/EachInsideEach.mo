// section: 7.2.5
// value: c[2].v = 2, c[3].w.x = 5, c[1].u = 4
model EachInsideEach "each in the modification of an array of components, at any depth"
  record R
    Real x;
  end R;
  model C
    Real v(start=7);
    Real u;
    R w;
  equation
    der(v) = 0;
    u = 2*v;
    w.x = 5;
  end C;
  C c[3](each v(fixed=true, each start=2), each w(x(each start=1)));
end EachInsideEach;
