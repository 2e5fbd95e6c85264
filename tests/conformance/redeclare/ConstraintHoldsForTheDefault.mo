// section: 7.3.2
// value: a.load.x = 5, b.load.x = 5, c.load.x = 8, d.load.x = 3, f = 7
package Loads
  model Any
    parameter Real k = 1;
    Real x = k*time;
  end Any;
  model First
    extends Any;
  end First;
  model Second
    extends Any;
  end Second;
  model Machine
    replaceable model Load = First constrainedby Any(k = 5);
    Load load;
  end Machine;
  model Own
    replaceable model Load = First(k = 3) constrainedby Any(k = 5);
    Load load;
  end Own;
  partial function sum2
    input Real a;
    input Real b;
    output Real c;
  end sum2;
  function plain
    extends sum2;
  algorithm
    c := a + b;
  end plain;
  replaceable function sum1 = plain constrainedby sum2(b = 6);
end Loads;
model ConstraintHoldsForTheDefault "The modifications of a constraining clause hold for the declared class, too"
  Loads.Machine a;
  Loads.Machine b(redeclare model Load = Loads.Second);
  Loads.Machine c(redeclare model Load = Loads.Second(k = 8));
  Loads.Own d;
  Real f = Loads.sum1(time);
end ConstraintHoldsForTheDefault;
