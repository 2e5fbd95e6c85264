within Lacuna.Interfaces;
partial model PartialFriction "Dry friction that sticks: mode and events"
  constant Integer Forward = 1 "Slides with positive speed";
  constant Integer Stuck = 0 "At rest, held by friction";
  constant Integer Backward = -1 "Slides with negative speed";
  Integer mode(start=0, fixed=true) "Forward, Stuck or Backward";
  Types.AngularVelocity w_fric(stateSelect=StateSelect.prefer) "Sliding speed";
  Types.Torque tau_fric "Friction torque against the speed";
  Types.Torque tau_slide "Level while it slides, not negative";
  Types.Torque tau_break "Level at which it breaks away, not below tau_slide";
  Types.Power loss "Heat";
protected
  constant Types.AngularVelocity unitVelocity = 1;
  constant Types.Inertia unitInertia = 1;
  constant Types.AngularVelocity w_small = 1e-10 "Slower than this is at rest";
  Types.Torque tau_hold "Torque that keeps it at rest; zero while it slides";
  Types.AngularVelocity w_stuck "Speed while stuck: zero unless something else sets it";
  Types.AngularVelocity w_along "Speed in the sense in which it slides; positive while stuck";
equation
  0 = if mode == Stuck then unitInertia*der(w_fric) else tau_fric - mode*tau_slide;
  tau_hold = if mode == Stuck then tau_fric else 0;
  w_stuck = if mode == Stuck then w_fric else 0;
  w_along = if mode == Stuck then unitVelocity else mode*w_fric;
  mode = if pre(mode) == Stuck then
      (if w_stuck > w_small then Forward elseif w_stuck < -w_small then Backward
       elseif tau_hold > tau_break then Forward elseif tau_hold < -tau_break then Backward else Stuck)
    elseif w_along < 0 then Stuck else pre(mode);
  when mode == Stuck then
    reinit(w_fric, 0);
  end when;
  loss = tau_fric*w_fric;
  annotation(Documentation(info="<html>
<p>Dry friction opposes motion with <code>tau_slide</code>; at rest it takes whatever value keeps the body at rest, up
to
<code>tau_break</code>. Torque is thus no function of speed: while it slides the torque is known and the acceleration
follows, while it is stuck the acceleration is known and the torque follows; <code>mode</code> says which.</p>
<p>Sliding ends when the speed passes zero; the speed is then set to exactly zero and its derivative is zero, so a stuck
element never creeps. In the same event the torque needed to hold it becomes known: if it exceeds
<code>tau_break</code> the
element slides on at once in the sense of that torque. All conditions are strict, so none is exactly on its switching
point when the integration goes on.</p>
<p>Why not a smooth law such as <code>tanh(w/w0)</code>: it creeps under a constant load and is stiff near rest. Two
stuck
elements on one rigid shaft share their load in no unique way; such a model is refused.</p>
<p>Reference: M. Otter, H. Elmqvist, S. E. Mattsson: Hybrid modeling in Modelica based on the synchronous data flow
principle, CACSD 1999.</p>
</html>"));
end PartialFriction;
