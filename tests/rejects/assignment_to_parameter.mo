// code: R058
// line: 8
// hint: declare it without
model M
  parameter Integer n = 1;
algorithm
  when time > 1 then
    n := 2;
  end when;
end M;
