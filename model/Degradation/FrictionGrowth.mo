within Lacuna.Degradation;
model FrictionGrowth "Growth that slows down: friction that approaches a level"
  extends Interfaces.PartialLaw;
  parameter Types.RateOfUse k(final min=0) = 0.01 "Growth for each unit of use of a new part";
  parameter Types.PerUnit level(final min=0) = 1.5 "Severity that is approached and never passed";
equation
  der(severity) = k*noEvent(max(0, 1 - severity/level));
  annotation(__Lacuna(law="friction", rate="k", shapes(level={0.7, 1.2, 1.5, 2}), wander=0.15, diffusion=0.02,
    reference="Blau 2005, On the nature of running-in; lubricant that ages towards a dry contact"),
    Documentation(info="<html>
<p>Friction grows as lubricant is lost and surfaces roughen, and settles where nothing is left to lose. Where the level is below
the limit, the limit is never reached.</p>
</html>"));
end FrictionGrowth;
