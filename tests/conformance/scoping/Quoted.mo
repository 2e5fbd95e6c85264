// section: 2.3.1
// value: y = 3
model Quoted
  Real 'one two' = 1;
  Real '2*x' = 2;
  Real y = 'one two' + '2*x';
end Quoted;
