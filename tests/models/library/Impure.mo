model Impure
  import Modelica.Math.Random.Utilities.*;
  parameter Integer id = initializeImpureRandom(5);
  function random = impureRandom(id=7);
  discrete Real a(start=0, fixed=true), b(start=0, fixed=true), sum(start=0, fixed=true), product(start=0, fixed=true);
equation
  when sample(0, 0.001) then
    a = impureRandom(id);
    b = random();
    sum = pre(sum) + a;
    product = pre(product) + (a - 0.5)*(b - 0.5);
  end when;
end Impure;
