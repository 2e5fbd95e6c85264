// section: 4.4.5
// refuse: R016 12
model FunctionOfConditional
  model Spring
    function twice
      input Real u;
      output Real y = 2 * u;
    algorithm
    end twice;
  end Spring;
  Spring spring if true;
  Real z = spring.twice(3);
end FunctionOfConditional;
