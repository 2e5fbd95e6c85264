model DrainingTanks "One tank drains into another through an orifice: a function"
  function orifice "Volume flow by Torricelli, regularised around zero head"
    input Real h(unit="m") "Head";
    input Real A(unit="m2") "Opening";
    input Real g(unit="m/s2") "Gravity";
    input Real small(unit="m") "Head below which the flow is linear";
    output Real q(unit="m3/s") "Flow";
  algorithm
    q := A*sqrt(2*g)*h/(h^2 + small^2)^0.25;
  end orifice;
  parameter Real S1(unit="m2") = 0.2 "Surface of the upper tank";
  parameter Real S2(unit="m2") = 0.1 "Surface of the lower tank";
  parameter Real A(unit="m2") = 1e-3 "Opening of both orifices";
  parameter Real g(unit="m/s2") = 9.81 "Gravity";
  parameter Real small(unit="m") = 1e-3 "Head below which the flow is linear";
  Real h1(unit="m", start=1, fixed=true), h2(unit="m", start=0.1, fixed=true);
equation
  S1*der(h1) = -orifice(h1, A, g, small);
  S2*der(h2) = orifice(h1, A, g, small) - orifice(h2, A, g, small);
  annotation(experiment(StopTime=60, Interval=0.1));
end DrainingTanks;
