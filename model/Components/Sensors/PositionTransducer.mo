within Lacuna.Components.Sensors;
model PositionTransducer "Analog position transducer with offset, gain error and lag"
  parameter Types.Angle offset = 0 "Reading at zero angle";
  parameter Types.PerUnit gain = 1 "Reading over true angle";
  parameter Types.Frequency f_c(final min=1e-3) = 1000 "Bandwidth";
  Interfaces.Flange_a flange "Flange whose angle is measured";
  Interfaces.RealOutput y(unit="rad") "Reading";
protected
  constant Real pi = 3.141592653589793;
initial equation
  y = gain*flange.phi + offset;
equation
  flange.tau = 0;
  der(y)/(2*pi*f_c) = gain*flange.phi + offset - y;
  annotation(Documentation(info="<html>
<p>Law: <code>gain phi + offset</code> behind a first-order lag, as of an RVDT with its demodulator. In a position
loop the
output settles at <code>(command - offset)/gain</code>: an offset is invisible to the loop.</p>
</html>"));
end PositionTransducer;
