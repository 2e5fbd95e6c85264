// section: 12.4.4
// value: y[3] = 6, n = 3
model ArrayOutputSizedByInput "sizes of results follow from inputs"
  function cum
    input Real u[:];
    output Real y[size(u, 1)];
  protected
    Real s = 0;
  algorithm
    for i in 1:size(u, 1) loop
      s := s + u[i];
      y[i] := s;
    end for;
  end cum;
  Real y[3] = cum({1, 2, 3}*time);
  parameter Integer n = size(cum({1, 2, 3}), 1);
end ArrayOutputSizedByInput;
