// section: 4.4.5
// refuse: R021 9
model TypeInWhatIsNotThere "the modifiers of a component that is not there fit"
  block Part
    parameter Boolean active = true;
    Real y = if active then 1 else 0;
  end Part;
  parameter Boolean detailed = false;
  Part part(active=not 1) if detailed;
  Real x = time;
end TypeInWhatIsNotThere;
