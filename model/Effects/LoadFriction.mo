within Lacuna.Effects;
model LoadFriction "Dry friction that grows with the transmitted torque"
  extends Interfaces.FrictionEffect;
  Lacuna.Interfaces.RealInput load(unit="N.m") "Transmitted torque";
  parameter Types.Torque tau_c(final min=0) = 0 "Level without load";
  parameter Real mu(final min=0) = 0 "Friction torque over transmitted torque";
equation
  flange.tau = tau_fric;
  tau_slide = tau_c + mu*noEvent(abs(load));
  tau_break = tau_slide;
  annotation(__Lacuna(effect="friction.load", attaches="flange", neutral(tau_c=0, mu=0), signals(load="transmitted"),
    signature="effort with the sign of the speed whose size follows the load",
    excitation="reversals under different loads", reference="Olaru, Puiu, Balan, Puiu 2004"));
end LoadFriction;
