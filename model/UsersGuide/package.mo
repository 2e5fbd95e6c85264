within Lacuna;
package UsersGuide "Signs, symbols and how to write a component"
  annotation(Documentation(info="<html>
<h4>Signs</h4>
<p>A <code>flow</code> variable (torque, force, current) is positive into the component that owns the connector. A
connection
makes potentials (angle, position, voltage) equal and flows sum to zero, so what a source gives enters its own flange
with a negative sign: <code>flange.tau = -u</code>.</p>
<p>Between two flanges <code>phi_rel = flange_b.phi - flange_a.phi</code>, and the torque <code>tau</code> of an
element is positive
when it pulls <code>flange_b</code> back: <code>tau = c*phi_rel</code>. Losses and loads are positive against positive
motion.
Electrical elements count voltage from <code>p</code> to <code>n</code> and current the same way, so <code>v*i</code>
is power
taken up; a supply's <code>power</code> is what it gives.</p>
<h4>Symbols</h4>
<p><code>phi</code> angle, <code>w</code> angular velocity, <code>a</code> acceleration, <code>tau</code> torque,
<code>J</code> inertia,
<code>c</code> stiffness, <code>d</code> damping between two bodies, <code>b</code> viscous friction to the housing,
<code>tau_c</code> dry friction, <code>s</code> position, <code>f</code> force, <code>v</code> voltage or speed,
<code>i</code> current,
<code>R</code>, <code>L</code>, <code>Ke</code> (back-EMF and torque constant), <code>pp</code> pole pairs,
<code>theta_e</code> electrical
angle, zero where the back-EMF of phase a rises through zero.</p>
<h4>Base classes</h4>
<ul>
<li><code>Interfaces.TwoPin</code>: a law between voltage and current</li>
<li><code>Interfaces.Rigid</code>: inertia or loss on a shaft, both flanges turn as one</li>
<li><code>Interfaces.Compliant</code>, <code>CompliantWithSpeed</code>: torque from relative angle, and speed</li>
<li><code>Interfaces.PartialFriction</code>: dry friction that sticks</li>
<li><code>Interfaces.PartialLeg</code>: inverter leg with ideal diodes</li>
<li><code>Interfaces.PartialDrive</code>, <code>PartialController</code>, <code>PartialEma</code>: parts of an
actuator to be redeclared</li>
<li><code>Interfaces.SISO</code>, <code>Source</code>: signals</li>
</ul>
<h4>Events</h4>
<p>Corners and jumps are written as conditions, which a solver locates. Conditions are strict and, where a mode holds a
quantity at zero, multiplied by the mode, so none sits on its switching point while nothing happens. A discrete
equation reads its own last value by <code>pre</code>; events are iterated until nothing changes.</p>
</html>"));
end UsersGuide;
