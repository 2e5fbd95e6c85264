within Lacuna.Effects;
block SensorZeroOverTemperature "Zero error of a sensor that follows a recorded temperature"
  extends Lacuna.Interfaces.SISO;
  Lacuna.Interfaces.RealInput temperature "Of what is around the sensor, in the unit of the model";
  parameter Real offset = 0 "Reading at zero, at zero temperature";
  parameter Real slope = 0 "Of the zero over the temperature, per kelvin where the model has kelvin";
equation
  y = u + offset + slope*temperature;
  annotation(__Lacuna(effect="sensor.temperature", attaches="sensor", neutral(offset=0, slope=0), signals(temperature="K"),
    signature="difference in one signal in proportion to a temperature",
    excitation="several temperatures", reference="IEC 60770-1"));
end SensorZeroOverTemperature;
