// section: 3.7.5
// value: up = 1, both = 2
model EdgeAndChange
  Boolean b(start=false, fixed=true) = time > 0.3 and time < 0.7;
  Integer up(start=0, fixed=true);
  Integer both(start=0, fixed=true);
equation
  when edge(b) then
    up = pre(up) + 1;
  end when;
  when change(b) then
    both = pre(both) + 1;
  end when;
end EdgeAndChange;
