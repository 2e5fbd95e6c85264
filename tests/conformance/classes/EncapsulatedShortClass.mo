// section: 4.5.2
// refuse: R001 8
model EncapsulatedShortClass "an encapsulated short class sees nothing outside"
  model R
    parameter Real R = 1;
    Real v = R;
  end R;
  encapsulated model S = R(R=2);
  S s;
end EncapsulatedShortClass;
