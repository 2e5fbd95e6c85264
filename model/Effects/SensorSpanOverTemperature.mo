within Lacuna.Effects;
block SensorSpanOverTemperature "Scale error of a sensor that follows a recorded temperature"
  extends Lacuna.Interfaces.SISO;
  Lacuna.Interfaces.RealInput temperature "Of what is around the sensor, in the unit of the model";
  parameter Real gain = 1 "Scale at zero temperature";
  parameter Real slope = 0 "Of the scale over the temperature, per kelvin where the model has kelvin";
equation
  y = u*(gain + slope*temperature);
  annotation(__Lacuna(effect="sensor.temperature", attaches="sensor", neutral(gain=1, slope=0), signals(temperature="K"),
    signature="difference in one signal in proportion to it and to a temperature",
    excitation="large values of the signal at several temperatures", reference="IEC 60770-1"));
end SensorSpanOverTemperature;
