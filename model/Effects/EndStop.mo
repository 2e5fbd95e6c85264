within Lacuna.Effects;
model EndStop "Mechanical limits within the stroke"
  extends Interfaces.FlangeEffect;
  parameter Types.Angle phi_max = 1e6 "Upper limit";
  parameter Types.Angle phi_min = -1e6 "Lower limit";
  parameter Types.RotationalStiffness c(final min=0) = 1 "Stiffness of the stop";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping of the stop";
equation
  tau = if angle > phi_max then max(c*(angle - phi_max) + d*w, 0)
    elseif angle < phi_min then min(c*(angle - phi_min) + d*w, 0) else 0;
  annotation(__Lacuna(effect="end_stop", attaches="flange",
    starts(phi_max={0.98, 0.8}, phi_min={-0.98, -0.8}), relative(phi_max="angle", phi_min="angle"),
    signature="effort at one end of the stroke only, zero elsewhere",
    excitation="motion up to the limits", reference="Brogliato 2016"));
end EndStop;
