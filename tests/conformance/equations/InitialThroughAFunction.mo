// section: 8.3.5.3
// value: x = 0, y = 2
model InitialThroughAFunction
  function same
    input Boolean b;
    output Boolean c;
  algorithm
    c := b;
  end same;
  Real x(start=0, fixed=true), y;
equation
  when same(initial()) then
    x = 2;
  end when;
  when initial() then
    y = 2;
  end when;
end InitialThroughAFunction;
