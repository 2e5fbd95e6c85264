// section: 8.3.5.3
// value: x = 3, n = 2
model InitialInAVectorThroughAFunction
  function isit
    input Boolean b;
    output Boolean c = b;
  algorithm
  end isit;
  Real x(start=1, fixed=true);
  Integer n(start=0, fixed=true);
equation
  when {isit(initial()), time > 0.5} then
    x = pre(x) + 2;
    n = pre(n) + 2;
  end when;
end InitialInAVectorThroughAFunction;
