within Lacuna.Degradation;
model ExponentialGrowth "Growth in proportion to what there is"
  extends Interfaces.PartialLaw;
  parameter Types.RateOfUse k(final min=0) = 0.01 "Relative growth for each unit of use";
equation
  der(severity) = k*severity;
  annotation(__Lacuna(law="exponential", rate="k", wander=0.15, diffusion=0.02,
    reference="Gebraeel, Lawley, Li, Ryan 2005, Residual-life distributions from component degradation signals"),
    Documentation(info="<html>
<p>The fault makes the load that makes the fault: an eccentric rotor pulls itself further off centre (unbalanced magnetic pull).
A part without any fault stays so.</p>
</html>"));
end ExponentialGrowth;
