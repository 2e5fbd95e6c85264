// section: 5.4
// refuse: R076 7
package Loads
  model B
    parameter Real x = 1;
  end B;
  model A outer model M = B(x = 1); M m; end A;
end Loads;
model OuterClassModified
  inner model M = Loads.B(x = 2);
  Loads.A a;
end OuterClassModified;
