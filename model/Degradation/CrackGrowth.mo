within Lacuna.Degradation;
model CrackGrowth "Growth that accelerates as that of a crack"
  extends Interfaces.PartialLaw;
  parameter Types.RateOfUse C(final min=0) = 0.01 "Growth for each unit of use at the limit";
  parameter Types.PerUnit m(final min=1) = 2 "Exponent: half of that of Paris, as stress intensity goes with the root of the length";
equation
  der(severity) = C*severity^m;
  annotation(__Lacuna(law="crack", rate="C", shapes(m={1.25, 1.5, 1.75, 2, 2.5, 3}), wander=0.15, diffusion=0.02,
    reference="Paris, Erdogan 1963, A critical analysis of crack propagation laws"),
    Documentation(info="<html>
<p>Cracks and spalls of races and teeth. The limit case m = 1 is exponential growth.</p>
</html>"));
end CrackGrowth;
