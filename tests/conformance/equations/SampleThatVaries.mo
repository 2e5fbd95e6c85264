// section: 3.7.5
// refuse: R053 7
model SampleThatVaries
  Integer n(start=0, fixed=true);
equation
  when
    sample(0, time) then
    n = pre(n) + 1;
  end when;
end SampleThatVaries;
