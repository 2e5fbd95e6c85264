within Lacuna.Components.Drives;
model HallSensor "Electrical angle of a rotor and its 60 degree sector, by true events"
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  Interfaces.Flange_a flange "Shaft whose angle is measured";
  Interfaces.IntegerOutput sector(start=-1)
    "Sectors passed: number n holds from 30 + 60 n to 90 + 60 n electrical degrees";
  Types.Angle theta_e "Electrical angle, zero where the back-EMF of phase a rises through zero";
  Types.PerUnit slope "Where in the sector: -1 at its lower bound, +1 at its upper bound";
protected
  constant Real pi = 3.141592653589793;
  constant Types.Angle width = pi/3 "Width of a sector";
  constant Types.Angle first = pi/6 "Lower bound of sector 0";
equation
  flange.tau = 0;
  theta_e = pp*flange.phi;
  sector = integer((theta_e - first)/width);
  slope = 2*(theta_e - first - sector*width)/width - 1;
  annotation(Documentation(info="<html>
<p>Three Hall sensors tell a six-step drive in which sixth of an electrical turn the rotor is. <code>sector</code>
counts
on over whole turns, in both directions, so no angle is ever wrapped; <code>mod(sector, 6)</code> is what the sensors
show. A sector begins with its lower bound.</p>
<p><code>slope</code> is the piecewise linear coordinate from which the windings form their trapezoids. It depends on
the
sector rather than on a wrapped angle, so each piece continues smoothly over its end while a solver looks for the
event.</p>
</html>"));
end HallSensor;
