// section: 5.4
// refuse: R013 8
model NoImplicitInnerOfAPartial
  partial model World
    parameter Real g = 9.81;
  end World;
  model Part
    outer World world;
    Real y = world.g*time;
  end Part;
  Part part;
end NoImplicitInnerOfAPartial;
