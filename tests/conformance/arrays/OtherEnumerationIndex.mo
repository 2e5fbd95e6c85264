// section: 10.5
// refuse: R044 7
model OtherEnumerationIndex
  type E = enumeration(a, b, c);
  type F = enumeration(u, v, w);
  Real x[E] = {1, 2, 3};
  Real y = x[F.v];
end OtherEnumerationIndex;
