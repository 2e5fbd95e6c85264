// section: 9.1.3
// refuse: R061 8
model ExpandableUnknown
  expandable connector Bus
  end Bus;
  Bus a, b;
equation
  connect(a.x, b.x);
end ExpandableUnknown;
