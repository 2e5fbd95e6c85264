within Lacuna.Effects;
block SensorOffset "Constant error of a sensor"
  extends Lacuna.Interfaces.SISO;
  parameter Real offset = 0 "Error";
equation
  y = u + offset;
  annotation(__Lacuna(effect="sensor.offset", attaches="sensor", twin="load.constant", neutral(offset=0), nests_in={"sensor.nonlinearity"},
    signature="constant difference in one signal only", excitation="none", reference="Fraden 2016"));
end SensorOffset;
