// section: 5.4
// refuse: R076 5
model OuterModified
  model C
    outer Real T(start=1);
    outer parameter Real p = 3;
    Real y = T;
  end C;
  inner Real T = 2;
  inner parameter Real p = 2;
  C c;
end OuterModified;
