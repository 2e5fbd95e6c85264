within Lacuna.Components.Drives;
block SixStepCommutation "Which leg is high, which low and which floats, from the sector"
  Interfaces.IntegerInput sector "Sector of the rotor's electrical angle";
  Interfaces.RealInput dir(unit="1") "Sense of the torque: positive or not";
  Interfaces.IntegerOutput leg[3] "Command of each leg: 1 to the positive rail, -1 to the negative rail, 0 floating";
  Interfaces.IntegerOutput pattern[3](each start=0) "Command for positive torque";
protected
  Integer sense "Sense of the torque, 1 or -1";
  Integer step[3](each start=0) "Sector as each phase sees it, 0 to 5";
equation
  sense = if dir > 0 then 1 else -1;
  for x in 1:3 loop
    step[x] = mod(sector - 2*(x - 1), 6);
    pattern[x] = if step[x] < 2 then 1 elseif step[x] == 3 or step[x] == 4 then -1 else 0;
    leg[x] = sense*pattern[x];
  end for;
  annotation(Documentation(info="<html>
<p>Each phase is driven for 120 electrical degrees where its back-EMF is flat, floats for 60, and again with the other
sign. Phase b follows phase a by two sectors, phase c by four. With <code>dir</code> negative every driven leg takes the
other rail, and the torque its other sign; the sector depends on the angle alone.</p>
</html>"));
end SixStepCommutation;
