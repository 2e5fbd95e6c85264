within Lacuna.Components.Sensors;
model Encoder "Encoder or resolver: angle in steps, read at a fixed rate"
  parameter Integer steps(final min=2) = 4096 "Steps in one turn";
  parameter Types.Time T(final min=1e-6) = 1e-3 "Time between two readings";
  Interfaces.Flange_a flange "Flange whose angle is measured";
  Interfaces.RealOutput y(unit="rad", start=0, fixed=true) "Reading";
protected
  constant Real pi = 3.141592653589793;
  parameter Types.Angle resolution = 2*pi/steps "Angle of one step";
equation
  flange.tau = 0;
  when sample(0, T) then
    y = resolution*floor(flange.phi/resolution);
  end when;
  annotation(Documentation(info="<html>
<p>Law: the largest multiple of <code>2 pi/steps</code> not above the angle, at each reading. Steps between two
readings cost
no event.</p>
</html>"));
end Encoder;
