within Lacuna.Degradation;
model WindingAgeing "Ageing of a winding that its own losses heat"
  extends Interfaces.PartialLaw;
  parameter Types.RateOfUse A(final min=0) = 0.01 "Growth for each unit of use of a new winding at its temperature";
  parameter Types.Temperature T_new(final min=200) = 373.15 "Winding, without fault";
  parameter Types.Temperature rise = 20 "Further rise of the temperature at the limit";
  constant Types.Temperature B = 11600 "Activation energy of 1 eV over the constant of Boltzmann";
  Types.Temperature T "Winding";
equation
  T = T_new + rise*severity;
  der(severity) = A*exp(B/T_new - B/T);
  annotation(__Lacuna(law="winding", rate="A", shapes(rise={10, 20, 35}), wander=0.15, diffusion=0.02,
    reference="Dakin 1948, Electrical insulation deterioration treated as a chemical rate phenomenon; IEC 60216"),
    Documentation(info="<html>
<p>Insulation ages by a chemical reaction whose rate follows Arrhenius; shorted turns and lost copper heat the winding that is left.</p>
</html>"));
end WindingAgeing;
