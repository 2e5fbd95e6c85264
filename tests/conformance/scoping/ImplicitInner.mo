// section: 5.4
// value: part.y = 9.81, world.g = 9.81
model ImplicitInner "an inner element that is missing is made, by its defaults"
  model World
    parameter Real g = 9.81;
  end World;
  model Part
    outer World world;
    Real y = world.g*time;
  end Part;
  Part part;
end ImplicitInner;
