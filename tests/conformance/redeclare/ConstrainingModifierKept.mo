// section: 7.3.2
// value: y = 12
model ConstrainingModifierKept
  model Base
    parameter Real p = 1;
    parameter Real q = 2;
  end Base;
  model D
    extends Base;
    Real y = p + q;
  end D;
  model U
    replaceable Base b constrainedby Base(p=10);
  end U;
  U u(redeclare D b);
  Real y = u.b.y;
end ConstrainingModifierKept;
