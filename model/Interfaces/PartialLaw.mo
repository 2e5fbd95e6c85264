within Lacuna.Interfaces;
partial model PartialLaw "Use when a fault grows slowly with use: extend, and give der(severity)"
  Types.PerUnit severity(start=0.05, fixed=true) "Share of the limit beyond which the actuator is removed";
  Types.RateOfUse growth "Of the severity, for each unit of use";
equation
  growth = der(severity);
  annotation(Documentation(info="<html>
<p>One second of the model is one unit of use: a flight cycle or an hour. See package <code>Degradation</code>.</p>
</html>"));
end PartialLaw;
