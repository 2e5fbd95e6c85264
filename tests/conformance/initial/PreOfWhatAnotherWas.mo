// section: 8.6
// value: n = 2
model PreOfWhatAnotherWas "pre(b) by pre(a), which stands after it and is known"
  Boolean a = time >= -1;
  Boolean b = not a;
  Boolean above;
  Integer n(start=0, fixed=true);
initial equation
  pre(b) = not pre(a);
  pre(above) = false;
  pre(a) = false;
equation
  above = a and sin(6.283185307179586*time + 0.1) >= 0;
  when change(above) and not edge(a) and not edge(b) then
    n = pre(n) + 1;
  end when;
  annotation(experiment(StopTime=1));
end PreOfWhatAnotherWas;
