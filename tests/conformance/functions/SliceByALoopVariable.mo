// section: 10.5
// value: x[1] at 1 = 0.75, x[2] at 1 = 0.375, x[3] at 1 = 0.125, r[3] at 0.4 = 3
model SliceByALoopVariable "elimination with pivoting: slices follow the variable of a loop whose range is known"
  function solve
    input Real A0[3, 3], b0[3];
    output Real x[3];
  protected
    Real A[3, 3] = A0, b[3] = b0, row[3], s;
    Integer p;
  algorithm
    for k in 1:3 loop
      p := k;
      for i in k + 1:3 loop
        if abs(A[i, k]) > abs(A[p, k]) then
          p := i;
        end if;
      end for;
      if p <> k then
        row := A[k, :];
        A[k, :] := A[p, :];
        A[p, :] := row;
        s := b[k];
        b[k] := b[p];
        b[p] := s;
      end if;
      for i in k + 1:3 loop
        s := A[i, k]/A[k, k];
        A[i, k:3] := A[i, k:3] - s*A[k, k:3];
        b[i] := b[i] - s*b[k];
      end for;
    end for;
    for k in 3:-1:1 loop
      x[k] := (b[k] - A[k, k + 1:3]*x[k + 1:3])/A[k, k];
    end for;
  end solve;
  Real A[3, 3] = [0, 1, 5*time; 2, 1, 1; 1, 5*time, 3], x[3] = solve(A, {1, 2, 3}), r[3] = A*x;
end SliceByALoopVariable;
