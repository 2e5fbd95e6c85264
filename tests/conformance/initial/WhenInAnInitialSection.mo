// section: 8.6
// refuse: F031 6
model WhenInAnInitialSection
  Real x;
initial equation
  when time > 0 then
    x = 2;
  end when;
equation
  der(x) = -x;
end WhenInAnInitialSection;
