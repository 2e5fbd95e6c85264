// section: 12.7.2
// value: z = 3.141592653589793
// value: w = 0.2
model PartialDerivativeAsArgument
  partial function Scalar
    input Real x;
    output Real y;
  end Scalar;
  function sine
    input Real x;
    input Real k;
    output Real y;
  algorithm
    y := sin(k*x);
  end sine;
  function slope = der(sine, x);
  function root
    input Scalar f;
    input Scalar df;
    input Real start;
    output Real x;
  algorithm
    x := start;
    while abs(f(x)) > 1e-12 loop
      x := x - f(x)/df(x);
    end while;
  end root;
  function twice
    input Scalar f;
    output Real y;
  algorithm
    y := 2*f(0);
  end twice;
  Real z = root(function sine(k = 1 + 0*time), function slope(k = 1 + 0*time), 2.5);
  Real w = twice(function slope(k = 0.1));
end PartialDerivativeAsArgument;
