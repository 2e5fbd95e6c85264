within Lacuna.Effects;
model StribeckFriction "Dry friction that falls from a breakaway level to a sliding level as speed grows"
  extends Interfaces.FrictionEffect;
  parameter Types.Torque tau_c(final min=0) = 0 "Level at high speed";
  parameter Types.Torque tau_s(final min=0) = 0 "Breakaway level";
  parameter Types.AngularVelocity w_s(final min=1e-6) = 1 "Stribeck speed";
equation
  flange.tau = tau_fric;
  tau_slide = tau_c + (tau_s - tau_c)*exp(-(w/w_s)*(w/w_s));
  tau_break = noEvent(max(tau_s, tau_slide));
  annotation(__Lacuna(effect="friction.stribeck", attaches="flange", neutral(tau_c=0, tau_s=0), levels={"tau_s"},
    starts(w_s={0.01, 0.05, 0.2}), relative(w_s="w"),
    signature="effort with the sign of the speed that falls within the first part of the speed range",
    excitation="slow reversals and steady low speeds, below and above the Stribeck speed",
    reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end StribeckFriction;
