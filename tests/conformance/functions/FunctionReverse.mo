// section: 10.5.2
// value: s = 4321, t = 10
model FunctionReverse "end in a subscript on the left"
  function rev
    input Real u[:];
    output Real y[size(u, 1)];
  algorithm
    for i in 1:size(u, 1) loop
      y[end - i + 1] := u[i];
    end for;
  end rev;
  Real v[4] = rev({1, 2, 3, 4}*time);
  Real s = v*{1000, 100, 10, 1}, t = sum(rev(rev(v)));
end FunctionReverse;
