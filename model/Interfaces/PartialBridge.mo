within Lacuna.Interfaces;
partial model PartialBridge "Rails and terminals of a three-phase bridge, with the power it loses"
  PositivePin p "Positive rail";
  NegativePin n "Negative rail";
  NegativePin a "Terminal of phase a";
  NegativePin b "Terminal of phase b";
  NegativePin c "Terminal of phase c";
  Types.Power loss "Power taken from the rails and not given to the load";
equation
  loss = p.v*p.i + n.v*n.i + a.v*a.i + b.v*b.i + c.v*c.i;
end PartialBridge;
