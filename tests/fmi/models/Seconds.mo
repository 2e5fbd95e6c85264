model Seconds "The next event is computed from the time at the last one"
  discrete Real next(start=1, fixed=true, unit="s");
  output Real left(unit="s");
equation
  when time >= pre(next) then
    next = floor(time) + 1;
  end when;
  left = next - time;
  annotation(experiment(StopTime=10));
end Seconds;
