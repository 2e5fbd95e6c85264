within Lacuna.Effects;
model GravityLoad "Unbalanced mass: a load that follows the sine of the angle"
  extends Interfaces.FlangeEffect;
  parameter Types.Torque mgl(final min=0) = 0 "Greatest torque: mass x gravity x lever";
  parameter Types.Angle phi = 0 "Angle ahead of the lowest position when the shaft is at zero";
equation
  tau = mgl*sin(angle + phi);
  annotation(__Lacuna(effect="load.gravity", attaches="flange", neutral(mgl=0), polar={"mgl", "phi"},
    signature="effort of one period a turn that does not depend on speed",
    excitation="more than one turn, slowly", reference="statics"));
end GravityLoad;
