// section: 12.7
// value: v = 6
model DerivativeThroughLoop "what a loop computes is differentiated"
  function f
    input Real x;
    output Real y = 0;
  algorithm
    for i in 1:3 loop
      y := y + x^i;
    end for;
  end f;
  Real y = f(time), v = der(y);
end DerivativeThroughLoop;
