// section: 4.4.5
// refuse: R032 7
model ModifierOfWhatIsNotThere "a component that is not there has no element either that its class has not"
  block Part
    Real y = 1;
  end Part;
  Part part(q=3) if false;
  Real x = time;
end ModifierOfWhatIsNotThere;
