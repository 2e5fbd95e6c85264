within Lacuna.Degradation;
model LinearWear "Wear at a steady rate"
  extends Interfaces.PartialLaw;
  parameter Types.RateOfUse k(final min=0) = 0.01 "Growth for each unit of use";
equation
  der(severity) = k;
  annotation(__Lacuna(law="linear", rate="k", wander=0.15, diffusion=0.02,
    reference="Archard 1953, Contact and rubbing of flat surfaces, at constant load"),
    Documentation(info="<html>
<p>Material is lost in proportion to the distance slid, and every flight slides as far.</p>
</html>"));
end LinearWear;
