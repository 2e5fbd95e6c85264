// section: 12.7.1
// value: phi = 2, w = 3, a = 4
model DerivativeNotHandedOn "noDerivative: a position, speed and acceleration that belong together"
  function position
    input Real q[3];
    input Real t;
    output Real phi;
  algorithm
    phi := q[1];
    annotation(derivative(noDerivative=q)=speed);
  end position;
  function speed
    input Real q[3];
    input Real t;
    input Real dt;
    output Real w;
  algorithm
    w := q[2]*dt;
    annotation(derivative(noDerivative=q, order=2)=acceleration);
  end speed;
  function acceleration
    input Real q[3];
    input Real t;
    input Real dt;
    input Real ddt;
    output Real a;
  algorithm
    a := q[3]*dt;
  end acceleration;
  discrete Real q[3](start={0, 0, 0}, each fixed=true) "it has no derivative";
  Real held[3] = {q[k] + 0*time for k in 1:3};
  Real phi = position(held, time);
  Real w = der(phi);
  Real a = der(w);
equation
  when time > 0.5 then
    q = {2, 3, 4};
  end when;
end DerivativeNotHandedOn;
