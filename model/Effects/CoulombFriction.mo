within Lacuna.Effects;
model CoulombFriction "Dry friction: constant level against the motion, sticks at rest"
  extends Interfaces.FrictionEffect;
  parameter Types.Torque tau_c(final min=0) = 0 "Level";
equation
  flange.tau = tau_fric;
  tau_slide = tau_c;
  tau_break = tau_c;
  annotation(__Lacuna(effect="friction.coulomb", attaches="flange", neutral(tau_c=0),
    nests_in={"friction.stribeck", "friction.asymmetric", "friction.load", "friction.position", "friction.presliding"},
    signature="effort of constant size with the sign of the speed; rest under small loads",
    excitation="reversals, and two speeds to tell it from viscous friction",
    reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end CoulombFriction;
