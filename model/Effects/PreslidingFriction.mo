within Lacuna.Effects;
model PreslidingFriction "Dry friction with elastic micro-motion before breakaway (Dahl)"
  extends Interfaces.FlangeEffect;
  parameter Types.Torque tau_c(final min=0) = 0 "Level of full sliding";
  parameter Types.Angle x_s(final min=1e-6) = 1 "Micro-motion over which the level builds up";
  Types.PerUnit z(start=0, fixed=true) "Share of the level that is built up";
equation
  der(z) = (w - noEvent(abs(w))*z)/x_s;
  tau = tau_c*z;
  annotation(__Lacuna(effect="friction.presliding", attaches="flange", neutral(tau_c=0),
    starts(x_s={3e-4, 3e-3, 3e-2}), relative(x_s="angle"),
    signature="hysteresis in position after every reversal, level reached after a short distance",
    excitation="small reversals, smaller than the micro-motion",
    reference="Dahl 1976; Canudas de Wit, Olsson, Astrom, Lischinsky 1995"));
end PreslidingFriction;
