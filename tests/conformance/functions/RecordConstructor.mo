// section: 12.6
// value: a.x = 1, a.y = 5, b.y = 3
model RecordConstructor
  record R
    Real x;
    Real y = x + 2;
  end R;
  R a = R(1, y=5);
  R b = R(x=time);
end RecordConstructor;
