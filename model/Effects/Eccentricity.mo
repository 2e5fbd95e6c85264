within Lacuna.Effects;
model Eccentricity "Static eccentricity of the rotor"
  extends Components.Drives.StarWinding(zeta=zeta_e);
  parameter Types.PerUnit zeta_e(final min=0, final max=0.9) = 0 "Eccentricity over air gap";
  annotation(__Lacuna(effect="motor.eccentricity", attaches="replace", replaces="StarWinding", neutral(zeta_e=0),
    signature="back-EMF modulated once an electrical turn", excitation="steady speed",
    reference="Battipede et al. 2015"));
end Eccentricity;
