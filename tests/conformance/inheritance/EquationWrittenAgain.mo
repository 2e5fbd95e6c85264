// section: 7.1
// value: x = 1
model A
  Real x;
equation
  x = time;
end A;
model EquationWrittenAgain
  extends A;
equation
  x =  time;
end EquationWrittenAgain;
