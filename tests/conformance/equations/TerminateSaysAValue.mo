// section: 8.3.8
// value: x = 0.5
model TerminateSaysAValue "the text of terminate may hold what varies"
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  when x > 0.5 then
    terminate("done at x = " + String(x) + " m");
  end when;
end TerminateSaysAValue;
