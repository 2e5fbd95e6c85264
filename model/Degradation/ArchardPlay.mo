within Lacuna.Degradation;
model ArchardPlay "Wear of a gear or screw whose play raises its own load"
  extends Interfaces.PartialLaw;
  parameter Types.RateOfUse k(final min=0) = 0.01 "Growth for each unit of use without play";
  parameter Types.PerUnit load(final min=0) = 3 "Impact load at the limit over the load without play";
equation
  der(severity) = k*(1 + load*severity);
  annotation(__Lacuna(law="archard", rate="k", shapes(load={1, 2, 4, 8, 16}), wander=0.15, diffusion=0.02,
    reference="Archard 1953, with an impact load that grows with the play as in Flodin, Andersson 1997"),
    Documentation(info="<html>
<p>Worn volume is proportional to load times sliding distance; play adds impacts to the load. The limit case load = 0 is
linear wear, a large load is exponential growth.</p>
</html>"));
end ArchardPlay;
