// code: R070
// line: 6
// hint: model or a block
record R
  Real x;
equation
  x = 1;
end R;
model M
  R r;
end M;
