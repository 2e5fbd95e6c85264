within Lacuna.Interfaces;
partial block Source "Block with one output signal"
  RealOutput y "Output signal";
end Source;
