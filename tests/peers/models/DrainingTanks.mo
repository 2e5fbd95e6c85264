model DrainingTanks "One tank drains into another through an orifice: a function"
  function orifice "Volume flow by Torricelli, regularised around zero head"
    input Real h(unit="m") "Head";
    input Real A(unit="m2") "Opening";
    output Real q(unit="m3/s") "Flow";
  protected
    constant Real small(unit="m") = 1e-3;
    constant Real g(unit="m/s2") = 9.81;
  algorithm
    q := A*sqrt(2*g)*h/(h^2 + small^2)^0.25;
  end orifice;
  parameter Real S1(unit="m2") = 0.2 "Surface of the upper tank";
  parameter Real S2(unit="m2") = 0.1 "Surface of the lower tank";
  parameter Real A(unit="m2") = 1e-3 "Opening of both orifices";
  Real h1(unit="m", start=1, fixed=true), h2(unit="m", start=0.1, fixed=true);
equation
  S1*der(h1) = -orifice(h1, A);
  S2*der(h2) = orifice(h1, A) - orifice(h2, A);
  annotation(experiment(StopTime=60, Interval=0.1));
end DrainingTanks;
