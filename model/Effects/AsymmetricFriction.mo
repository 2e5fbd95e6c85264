within Lacuna.Effects;
model AsymmetricFriction "Dry friction with a different level in each direction"
  extends Interfaces.FrictionEffect;
  parameter Types.Torque tau_pos(final min=0) = 0 "Level while the speed is positive";
  parameter Types.Torque tau_neg(final min=0) = 0 "Level while the speed is negative";
equation
  flange.tau = tau_fric + (tau_pos - tau_neg)/2;
  tau_slide = noEvent(max((tau_pos + tau_neg)/2, 0));
  tau_break = tau_slide;
  annotation(__Lacuna(effect="friction.asymmetric", attaches="flange", neutral(tau_pos=0, tau_neg=0),
    levels={"tau_pos", "tau_neg"},
    signature="effort of constant size with the sign of the speed, larger one way",
    excitation="both directions at several speeds",
    reference="Armstrong-Helouvry 1991, chapter 4"),
    Documentation(info="<html>
<p>A symmetric friction of the mean level beside a constant torque of half the difference: the same law, at rest too, where
it holds any torque between <code>-tau_neg</code> and <code>tau_pos</code>.</p>
</html>"));
end AsymmetricFriction;
