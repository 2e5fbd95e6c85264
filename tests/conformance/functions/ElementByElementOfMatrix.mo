// section: 12.4.6
// value: y[1,2] = 12, y[2,1] = 13
model ElementByElementOfMatrix
  function f
    input Real a;
    input Real b;
    output Real c;
  algorithm
    c := a + b;
  end f;
  Real y[2, 2] = f([1, 2; 3, 4], 10);
end ElementByElementOfMatrix;
