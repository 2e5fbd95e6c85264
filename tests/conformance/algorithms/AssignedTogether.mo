// section: 11.2.1.1
// value: P[1,2] at 0.9 = 2, x[1] at 0.9 = 2, x[2] at 0.9 = 1, y[1] = 2, y[2] = 1, z[1] = 2, z[2] = 3, z[3] = 1
model AssignedTogether "what an assignment of several elements reads are the values before it"
  function squared
    input Real P[2,2];
    output Real Q[2,2];
  algorithm
    Q := P*P;
  end squared;
  function exchanged
    input Real a, b;
    output Real c = b, d = a;
  algorithm
  end exchanged;
  discrete Real P[2,2](start=[1, 1; 0, 1], each fixed=true), x[2](start={1, 2}, each fixed=true);
  discrete Real y[2](start={1, 2}, each fixed=true);
  Real z[3];
algorithm
  when sample(0.5, 1) then
    P := squared(P);
    x := {x[2], x[1]};
  end when;
  when time > 0.7 then
    (y[1], y[2]) := exchanged(y[1], y[2]);
  end when;
algorithm
  z := {time, 2, 3};
  z := {z[2], z[3], z[1]};
end AssignedTogether;
