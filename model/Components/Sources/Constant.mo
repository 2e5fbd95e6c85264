within Lacuna.Components.Sources;
block Constant "Constant signal"
  extends Interfaces.Source;
  parameter Real k = 0 "Value";
equation
  y = k;
end Constant;
