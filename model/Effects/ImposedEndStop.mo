within Lacuna.Effects;
model ImposedEndStop "Mechanical limits of a device within its stroke"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Length s_max = 1e6 "Upper limit";
  parameter Types.Length s_min = -1e6 "Lower limit";
  parameter Types.Stiffness k(final min=0) = 0 "Stiffness of the stops";
equation
  f = k*noEvent(if s > s_max then s - s_max elseif s < s_min then s - s_min else 0);
  annotation(__Lacuna(effect="end_stop", attaches="imposed", neutral(k=0),
    starts(s_max={0.95, 0.7}, s_min={-0.95, -0.7}), relative(s_max="s", s_min="s"),
    signature="force at one end of the stroke only", excitation="motion up to the limits", reference="Brogliato 2016"));
end ImposedEndStop;
