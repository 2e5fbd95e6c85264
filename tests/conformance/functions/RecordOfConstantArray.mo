// section: 12.6.1
// value: s.X[1] = 0.3
// value: r.c = 5
model RecordOfConstantArray
  constant Real x0[1] = {0.3};
  record State
    Real T;
    Real X[1];
  end State;
  record WithConstant
    constant Real c = 5;
    Real x;
  end WithConstant;
  State s;
  WithConstant r, q;
equation
  s = State(time, x0);
  r = WithConstant(time);
  q = r;
end RecordOfConstantArray;
