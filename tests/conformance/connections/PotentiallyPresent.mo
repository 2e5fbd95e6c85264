// section: 9.1.3
// value: y = 1
model PotentiallyPresent
  expandable connector Bus
    Real never;
  end Bus;
  Bus bus;
  Real y = 1;
end PotentiallyPresent;
