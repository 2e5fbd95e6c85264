// section: 12.4.3
// value: q = 3, r = 1, s = 3
model SeveralResults
  function divide
    input Real a, b;
    output Real q, r;
  algorithm
    q := floor(a/b);
    r := a - q*b;
  end divide;
  Real q, r, s;
equation
  (q, r) = divide(7, 2);
  (s) = divide(7, 2);
end SeveralResults;
