// section: 7.3
// value: b.y at 0.5 = 0.25, b.y = 1
model PackageRedeclaredWithFunction
  partial package Law
    replaceable partial function f
      input Real u;
      output Real y;
    end f;
  end Law;
  package Lin
    extends Law;
    redeclare replaceable function extends f
    algorithm
      y := 2*u;
    end f;
  end Lin;
  model Box
    replaceable package L = Lin constrainedby Law;
    Real y = L.f(time);
  end Box;
  function square
    input Real u;
    output Real y;
  algorithm
    y := u^2;
  end square;
  Box b(redeclare package L = Lin(redeclare function f = square));
end PackageRedeclaredWithFunction;
