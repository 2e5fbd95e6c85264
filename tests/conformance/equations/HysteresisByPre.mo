// section: 3.7.5
// value: n = 2
model HysteresisByPre "a relay with memory of its own"
  Real u = sin(12.566370614359172*time);
  Boolean high(start=false, fixed=true);
  Integer n(start=0, fixed=true);
equation
  high = if pre(high) then u > -0.5 else u > 0.5;
  when high then
    n = pre(n) + 1;
  end when;
end HysteresisByPre;
