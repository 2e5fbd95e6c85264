// section: 5.3.2
// value: x = 4
model ThroughAComponent
  model A
    parameter Real k = 2;
    function f
      input Real u;
      output Real y = 2*u;
    algorithm
    end f;
  end A;
  A a;
  Real x = a.f(2);
end ThroughAComponent;
