within Lacuna.Effects;
model ShortCircuit "Shorted turns in one phase"
  extends Components.Drives.StarWinding(shorted={if phase == 1 then fraction else 0, if phase == 2 then fraction else 0,
    if phase == 3 then fraction else 0});
  parameter Types.PerUnit fraction(final min=0, final max=0.9) = 0 "Fraction of the turns that is shorted";
  parameter Integer phase = 1 "Number of the phase";
  annotation(__Lacuna(effect="motor.short_circuit", attaches="replace", replaces="StarWinding", neutral(fraction=0),
    variants(phase={1, 2, 3}), location={":a", ":b", ":c"},
    signature="less back-EMF, resistance and inductance in one phase",
    excitation="steady speed with current in all phases", reference="Battipede et al. 2015"));
end ShortCircuit;
