// section: 4.1
// refuse: R017 13
model ProtectedFunctionOfComponent
  model Spring
  protected
    function twice
      input Real u;
      output Real y = 2 * u;
    algorithm
    end twice;
  end Spring;
  Spring spring;
  Real z = spring.twice(3);
end ProtectedFunctionOfComponent;
