model Stair "A count that goes up every second and ends the simulation at ten; no state"
  output Integer counter(start=1, fixed=true);
equation
  when sample(1, 1) then
    counter = pre(counter) + 1;
  end when;
  when counter >= 10 then
    terminate("ten steps are done");
  end when;
  annotation(experiment(StopTime=12, Interval=0.2));
end Stair;
