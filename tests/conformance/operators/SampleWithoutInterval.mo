// section: 3.7.5
// refuse: R053 6
model SampleWithoutInterval
  Integer n(start=0, fixed=true);
equation
  when sample(0, 0) then
    n = pre(n) + 1;
  end when;
end SampleWithoutInterval;
