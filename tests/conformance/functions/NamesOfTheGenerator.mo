// section: 11.2.2
// value: y = 43, s = 14, u = 3, v = 2
model NamesOfTheGenerator "variables called as those that loops and simultaneous assignments need"
  function f
    input Real z[:];
    input Integer n;
    output Real y = 0;
  protected
    Real i_1 = 7*z[1], i = 5, i_2 = 30*z[1];
  algorithm
    for i in 1:n loop
      y := y + z[i] + (i_1 - 7) + (i_2 - 30);
    end for;
    y := y + i_1 + i_2 + 0*i;
  end f;
  function g
    input Real z[:];
    input Integer n;
    output Real s, u, v;
  protected
    Real s_out = z[1], u_out = z[1], m = z[1], tmp1 = z[1], 'double' = z[1], NULL = z[1], next = z[1];
    Real j_2 = 2*z[1], before_1 = z[1], before_2 = z[2], before_3 = z[3], x[2] = {2, 3};
  algorithm
    s := sum(j_2*z[j] for j in 1:n) + before_1 + before_2 - before_3 + 2;
    x[1:n - n + 2] := {x[2], x[1]};
    x := {x[1]*before_1, x[2]*before_3/before_3};
    u := x[1];
    v := x[2];
    for k in 1:n loop
      v := v + 0*k*s_out*u_out*m*tmp1*'double'*NULL*next;
    end for;
  end g;
  Integer n = 2 + integer(time);
  Real y = f({1, 2, 3}, n), s, u, v;
equation
  (s, u, v) = g({1, 2, 3}, n);
end NamesOfTheGenerator;
