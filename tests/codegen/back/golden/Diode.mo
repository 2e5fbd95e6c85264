model Diode "a nonlinear element in series with a resistor, feeding a capacitor"
  parameter Real R(unit = "Ohm") = 100;
  parameter Real C(unit = "F") = 1e-5;
  parameter Real I_s(unit = "A") = 1e-9;
  parameter Real V_t(unit = "V") = 0.025;
  parameter Real U(unit = "V") = 5;
  parameter Real T(unit = "s") = 0.01;
  Real u(unit = "V");
  Real v(unit = "V");
  Real i(unit = "A");
  Real u_C(unit = "V", start = 0, fixed = true);
equation
  u = if time < T then U else -U;
  u = R*i + v + u_C;
  i = I_s*(exp(v/V_t) - 1);
  C*der(u_C) = i;
end Diode;
