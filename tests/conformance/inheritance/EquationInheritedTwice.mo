// section: 7.1
// value: x = 1
model A
  Real x;
equation
  x = time;
end A;
model B
  extends A;
end B;
model C
  extends A;
end C;
model EquationInheritedTwice
  extends B;
  extends C;
end EquationInheritedTwice;
