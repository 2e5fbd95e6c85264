// section: 12.6
// value: a.y = 42
model RecordConstantIsNoInput
  record R
    Real x;
    constant Integer n = 42;
    Real y = n;
  end R;
  R a = R(1);
end RecordConstantIsNoInput;
