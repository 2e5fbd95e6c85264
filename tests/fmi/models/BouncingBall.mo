model BouncingBall "A ball that is thrown back, until it is too slow and rests"
  parameter Real g(unit="m/s2") = -9.81 "Gravity";
  parameter Real e(min=0.5, max=1) = 0.7 "Share of the speed that is kept";
  parameter Real v_min(unit="m/s") = 0.1 "Speed below which it rests";
  output Real h(unit="m", start=1, fixed=true) "Height";
  output Real v(unit="m/s", start=0, fixed=true) "Speed";
  discrete Boolean resting(start=false, fixed=true) "It has come to rest";
equation
  der(h) = if pre(resting) then 0 else v;
  der(v) = if pre(resting) then 0 else g;
  when h < 0 and v < 0 then
    reinit(h, 0);
    resting = -e*pre(v) < v_min;
    reinit(v, if -e*pre(v) < v_min then 0 else -e*pre(v));
  end when;
  annotation(experiment(StopTime=3, Interval=0.01));
end BouncingBall;
