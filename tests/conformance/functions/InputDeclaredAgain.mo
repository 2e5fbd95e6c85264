// section: 7.1
// value: y = -1
function A
  input Real a;
  input Real b;
  output Real y;
algorithm
  y := a - b;
end A;
function B
  extends A;
  input Real a;
end B;
model InputDeclaredAgain
  Real y = B(1, 2);
end InputDeclaredAgain;
