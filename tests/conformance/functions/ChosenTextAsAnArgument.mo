// section: 12.4.1
// value: y at 0.4 = 0.8, y = 1
model ChosenTextAsAnArgument
  function f
    input String c;
    input Real u;
    output Real y;
  algorithm
    y := if c == "once" then u else 2*u;
  end f;
  Boolean late = time > 0.5;
  Real y = f(if late then "once" else "twice", time);
end ChosenTextAsAnArgument;
