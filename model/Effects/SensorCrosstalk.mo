within Lacuna.Effects;
block SensorCrosstalk "Sensor that shows a part of what another one records"
  extends Lacuna.Interfaces.SISO;
  Lacuna.Interfaces.RealInput other "Of the same unit";
  parameter Real share = 0 "Of the other quantity, in the reading";
equation
  y = u + share*other;
  annotation(__Lacuna(effect="sensor.crosstalk", attaches="sensor", neutral(share=0), signals(other="recorded"),
    signature="difference in one signal in proportion to another one",
    excitation="motion of the other signal while this one rests", reference="Fraden 2016"));
end SensorCrosstalk;
