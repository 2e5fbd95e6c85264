type Mode = enumeration(low, high);
connector Pin
  Real v(unit = "V");
  flow Real i(unit = "A");
end Pin;
record Data
  parameter Real a = 1;
  Real c[2] = {1, 2};
end Data;
function f
  input Real a;
  input Real s = 2;
  output Real b;
  output Integer c;
algorithm
  b := if a > s then a else s;
  c := 1;
end f;
function g
  input Real v[:];
  output Real s;
algorithm
  s := 0;
  while s < sum(v) loop
    s := s + 1;
    if s > 100 then
      break;
    end if;
  end while;
end g;
package Sub
  constant Real c = 3;
  model Inner
    Real q(start = 1);
  equation
    der(q) = -q;
  end Inner;
end Sub;
partial model Two
  Pin pin;
  Pin other;
end Two;
model Part
  extends Two;
  parameter Real R(min = 0) = 2;
  parameter Integer n = 2;
  Real x[n];
equation
  pin.v - other.v = R*pin.i;
  pin.i + other.i = 0;
  x = fill(pin.v, n);
end Part;

model Fuzz
  extends Part(R = sin((time .* time), k, (time > time)));
  Data k[{(time - 0), (time >= pin)}];
equation
  time = ((if k > (sign(n, k, time) ./ {time for i in Mode.low}) then ({i, b} > (time ^ true)) else {(time <> p) for i in Mode}):div(1));
algorithm
  for i in 1:3 loop
    z.i := ((([3.5, time; Mode.low, Sub.c] ./ (phi == 1)) - (Mode.low .* (if time > time then 3.5 else 0))) + sin(((time ^ time) ./ (if time > b then time else i))));
    part[("text" ^ part)].v := ((((if false > time then "text" else v) * (time <> time)) or ((false .^ pin) + 1e-3)) ./ w);
  end for;
  y[time].b := time;
end Fuzz;
