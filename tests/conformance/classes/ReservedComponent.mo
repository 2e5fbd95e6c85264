// section: 4.9
// refuse: R074 4
model ReservedComponent
  Real String = 1;
end ReservedComponent;
