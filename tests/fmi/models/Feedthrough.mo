model Feedthrough "Every kind of input, passed on"
  parameter Real gain = 1 "Of the real signal";
  input Real u "Real";
  input Integer n(min=-4, max=6) "Integer";
  input Boolean b "Boolean";
  output Real y, doubled;
  output Integer m;
  output Boolean c;
equation
  y = u;
  doubled = 2*gain*u;
  m = n;
  c = b;
end Feedthrough;
