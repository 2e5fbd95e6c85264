// section: 9.1.3
// value: y = 2
model ExpandableNested "a bus within a bus"
  expandable connector Sub
  end Sub;
  expandable connector Bus
    Sub sub;
  end Bus;
  connector O = output Real;
  connector I = input Real;
  block S
    O y = 2*time;
  end S;
  block R
    I u;
    O y = u;
  end R;
  S s;
  R r;
  Bus b;
  Real y = r.y;
equation
  connect(s.y, b.sub.v);
  connect(b.sub.v, r.u);
end ExpandableNested;
