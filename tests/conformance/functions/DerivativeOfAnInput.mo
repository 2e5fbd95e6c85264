// section: 12.7.1
// value: y = 0, v = 0, acc = 0
model DerivativeOfAnInput "Inputs have no derivatives but those that the annotation says"
  function position
    input Real q[3];
    input Real dummy;
    output Real y;
  algorithm
    y := q[1];
    annotation(derivative(noDerivative=q)=speed, InlineAfterIndexReduction=true);
  end position;
  function speed
    input Real q[3];
    input Real dummy;
    input Real der_dummy;
    output Real y;
  algorithm
    y := q[2];
    annotation(derivative(noDerivative=q, order=2)=acceleration);
  end speed;
  function acceleration
    input Real q[3];
    input Real dummy;
    input Real der_dummy;
    input Real der_2_dummy;
    output Real y;
  algorithm
    y := q[3];
  end acceleration;
  input Real phi, w, a;
  Real y = position({phi, w, a}, time);
  Real v = der(y);
  Real acc = der(v);
end DerivativeOfAnInput;
