within Lacuna.Effects;
model EndStop "Mechanical limits within the stroke"
  extends Interfaces.FlangeEffect;
  parameter Types.Angle phi_max = 1e6 "Upper limit";
  parameter Types.Angle phi_min = -1e6 "Lower limit";
  parameter Types.RotationalStiffness c(final min=0) = 1 "Stiffness of the stop";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping of the stop";
  Lacuna.Interfaces.RealInput J(unit="kg.m2") "Inertia of the shaft";
  constant Types.AngularVelocity unit_w = 1;
  Types.RotationalStiffness c_unit = J*unit_w*unit_w "Stiffness on which the shaft swings at 1 rad/s";
  Types.RotationalDamping d_unit = J*unit_w "Damping that stops the shaft within 1 s";
equation
  tau = if angle > phi_max then max(c*(angle - phi_max) + d*w, 0)
    elseif angle < phi_min then min(c*(angle - phi_min) + d*w, 0) else 0;
  annotation(__Lacuna(effect="end_stop", attaches="flange", signals(J="inertia"),
    starts(phi_max={1000, 0.99, 0.8}, phi_min={-1000, -0.99, -0.8}, c={300, 3000, 3e4}, d={20}),
    relative(phi_max="angle", phi_min="angle", c="c_unit", d="d_unit"),
    signature="effort at one end of the stroke only, zero elsewhere",
    excitation="motion up to the limits", reference="Brogliato 2016"));
end EndStop;
