// section: 12.8
// refuse: R066 4
model EventsOfAFunctionNotInlined "GenerateEvents beside Inline = false"
  function f
    input Real x;
    output Real y;
  algorithm
    y := if x > 0.5 then 1 else 0;
    annotation(GenerateEvents=true, Inline=false);
  end f;
  Real y = f(time);
end EventsOfAFunctionNotInlined;
