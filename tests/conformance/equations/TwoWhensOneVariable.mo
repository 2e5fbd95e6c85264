// section: 8.3.5.3
// refuse: S011 9
model TwoWhensOneVariable "single assignment rule"
  Integer n(start=0, fixed=true);
equation
  when time > 0.3 then
    n = 1;
  end when;
  when time > 0.6 then
    n = 2;
  end when;
end TwoWhensOneVariable;
