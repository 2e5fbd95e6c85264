// section: 4.9.8
// value: x = 0.367879441171
// note: y could be the state in place of x; the solution is the same
model StateSelectNeverOfTwo
  Real x(start=1, fixed=true, stateSelect=StateSelect.never);
  Real y;
equation
  der(x) = -x;
  y = 2*x + sin(y)/3;
end StateSelectNeverOfTwo;
