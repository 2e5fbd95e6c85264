// section: 7.3.1
// value: b.X[2] = 1, b.T = 5, y = 6
partial package PM
  constant Integer nX;
  replaceable partial model BP
    Real X[nX];
    Real T;
  end BP;
  replaceable partial function dv
    input Real p;
    output Real eta;
  end dv;
end PM;
package MA
  extends PM(nX = 2);
  redeclare model extends BP(T(stateSelect = StateSelect.prefer))
  equation
    X = {0, 1};
    T = 5;
  end BP;
  redeclare function extends dv
  algorithm
    eta := 2*p;
  end dv;
end MA;
model ExtendedInAPackage
  MA.BP b;
  Real y = MA.dv(3);
end ExtendedInAPackage;
