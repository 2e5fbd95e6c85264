model MagneticCore "A saturating coil on a sine: an implicit nonlinear equation"
  parameter Real R(unit="Ohm") = 5, V(unit="V") = 20, w(unit="rad/s") = 314;
  parameter Real L(unit="H") = 0.05 "Unsaturated inductance";
  parameter Real psi_s(unit="Wb") = 0.05 "Flux linkage where saturation sets in";
  Real psi(unit="Wb", start=0, fixed=true) "Flux linkage";
  Real i(unit="A", start=0) "Current";
equation
  der(psi) = V*sin(w*time) - R*i;
  psi = psi_s*tanh(L*i/psi_s) + 0.02*L*i;
  annotation(experiment(StopTime=0.1, Interval=1e-4));
end MagneticCore;
