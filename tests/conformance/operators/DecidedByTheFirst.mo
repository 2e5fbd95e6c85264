// section: 3.3
// value: some = false, all = true, late = true
model DecidedByTheFirst "an operand that decides alone needs no other: the largest of no elements, an element outside"
  parameter Integer n = 0;
  parameter Boolean b[n] = fill(true, n);
  parameter Real v[2] = {1, 2};
  parameter Boolean some = size(b, 1) > 0 and max(b);
  parameter Boolean all = size(b, 1) == 0 or min(b);
  parameter Boolean late = not (size(v, 1) > 2 and v[3] > 0);
  Real x = time;
end DecidedByTheFirst;
