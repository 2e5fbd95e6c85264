// section: 10.6
// value: y[3] = 3, z[2,3] = 6
model SliceOfComponents
  model A
    parameter Real p = 1;
    Real v[2] = {p, 2*p};
  end A;
  A a[3](p={1,2,3});
  Real y[3] = a.p;
  Real z[2,3] = transpose(a.v);
end SliceOfComponents;
