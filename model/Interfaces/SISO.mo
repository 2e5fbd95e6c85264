within Lacuna.Interfaces;
partial block SISO "Block with one input signal and one output signal"
  RealInput u "Input signal";
  RealOutput y "Output signal";
end SISO;
