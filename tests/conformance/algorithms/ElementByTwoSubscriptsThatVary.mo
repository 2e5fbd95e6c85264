// section: 11.2.1
// value: A[1,2] = 3, A[2,1] = 7, A[2,2] = 8, A[2,3] = 10, A[1,1] = 0, B[2,2] = 5, B[1,2] = 0, q[2].w[1] = 4
model ElementByTwoSubscriptsThatVary
  record R
    Real w[2];
  end R;
  Integer i(start=1, fixed=true), j(start=2, fixed=true), k = if time > 0.5 then 2 else 1;
  discrete Real A[2, 3](each start=0, each fixed=true);
  Real B[2, 2];
  R q[2];
algorithm
  when time > 0.5 then
    A[i, j] := 3;
    A[i + 1, 1:2] := {7, 8};
    i := 2;
    j := pre(j);
    A[i, j + 1] := A[i, j] + 2;
  end when;
algorithm
  B := zeros(2, 2);
  B[k, k] := 5*time;
algorithm
  q[1].w := {1, 2};
  q[2].w := {1, 2};
  q[k].w[3 - k] := 4;
end ElementByTwoSubscriptsThatVary;
