// section: 8.5
// value: a = 2, b = 20, c = 21
model WhenChainedSameInstant "one when-clause makes the next one true, at one instant"
  Integer a(start=1, fixed=true), b(start=0, fixed=true), c(start=0, fixed=true);
equation
  when time > 0.5 then
    a = pre(a) + 1;
  end when;
  when a > 1 then
    b = 10*a;
  end when;
  when b > 5 then
    c = b + 1;
  end when;
end WhenChainedSameInstant;
