within Lacuna.Components.Drives;
model StarWinding "Stator of a trapezoidal machine: three windings in star with isolated neutral"
  import Lacuna.Types.Eccentricity;
  parameter Types.Resistance R(final min=0, start=1) "Resistance of a phase";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance of a phase";
  parameter Types.BackEmfConstant Ke(start=0.1) "Peak back-EMF constant of a phase";
  parameter Integer pp(final min=1) = 2 "Pole pairs";
  parameter Types.PerUnit zeta(final min=0, final max=0.99) = 0 "Static eccentricity over air gap";
  parameter Eccentricity convention = Eccentricity.RotorAngle "How eccentricity modulates the back-EMF";
  parameter Types.Angle phi_zeta = 0
    "Direction of the narrow gap from the axis of phase a, electrical (StatorFixed only)";
  parameter Types.PerUnit shorted[3](each final min=0, each final max=0.99) = {0, 0, 0} "Shorted turns of each phase";
  Interfaces.PositivePin pin_a "Terminal of phase a";
  Interfaces.PositivePin pin_b "Terminal of phase b";
  Interfaces.PositivePin pin_c "Terminal of phase c";
  Interfaces.Flange_b flange "Shaft";
  Interfaces.IntegerOutput sector "Sector of the electrical angle";
  PhaseWinding a(R=R, L=L, shorted=shorted[1]) "Phase a";
  PhaseWinding b(R=R, L=L, shorted=shorted[2]) "Phase b";
  PhaseWinding c(R=R, L=L, shorted=shorted[3]) "Phase c";
  HallSensor hall(pp=pp) "Sector of the rotor";
  Types.Torque tau "Electromagnetic torque";
  Types.Power loss "Heat";
  Types.Energy stored "Magnetic energy";
protected
  constant Real pi = 3.141592653589793;
  final parameter Types.Angle axis[3] = {0, 2*pi/3, 4*pi/3} "Axes of the phases, electrical";
  Types.PerUnit shape[3] "Trapezoid of each phase";
  Types.PerUnit gap[3] "Modulation of each phase by the air gap";
  Integer step[3](each start=0) "Sector as each phase sees it, 0 to 5";
equation
  connect(pin_a, a.p);
  connect(pin_b, b.p);
  connect(pin_c, c.p);
  connect(a.n, b.n);
  connect(b.n, c.n);
  connect(flange, a.flange);
  connect(flange, b.flange);
  connect(flange, c.flange);
  connect(flange, hall.flange);
  connect(hall.sector, sector);
  for x in 1:3 loop
    step[x] = mod(sector - 2*(x - 1), 6);
    shape[x] = if step[x] < 2 then 1 elseif step[x] == 2 then -hall.slope
      elseif step[x] < 5 then -1 else hall.slope;
    gap[x] = if convention == Eccentricity.RotorAngle then 1 + zeta*cos(hall.theta_e - pi/3)
      else 1 + zeta*cos(phi_zeta - axis[x]);
  end for;
  a.k = Ke*shape[1]*gap[1];
  b.k = Ke*shape[2]*gap[2];
  c.k = Ke*shape[3]*gap[3];
  tau = a.tau + b.tau + c.tau;
  loss = a.loss + b.loss + c.loss;
  stored = a.stored + b.stored + c.stored;
  annotation(Documentation(info="<html>
<p>Phase x has the back-EMF constant <code>k_x = Ke trap(theta_e - axis_x) gap_x</code>. The trapezoid is flat from 30
to 150
electrical degrees; its corners are the bounds of the sectors, so in every sector it is constant or linear. The
neutral is isolated: the three currents sum to zero, two of them are states, and the potential of the star point
follows, also for an unbalanced machine.</p>
<p>Static eccentricity <code>zeta</code> modulates the constants.
<code>RotorAngle</code>: <code>gap = 1 + zeta cos(theta_e - 60 deg)</code>, common to the phases, the reading of
Battipede et al. (2015) whose constant follows the rotor's angle. <code>StatorFixed</code>:
<code>gap_x = 1 + zeta cos(phi_zeta - axis_x)</code>, constant for each phase, the first order of the flux in an air gap
<code>g0 - x0 cos(alpha)</code> that does not turn with the rotor.</p>
<p>Reference: B. K. Lee, M. Ehsani: Advanced simulation model for brushless DC motor drives, Electric Power Components
and
Systems 31 (2003) 841-868.</p>
</html>"));
end StarWinding;
