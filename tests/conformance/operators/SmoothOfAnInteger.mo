// section: 3.7.4
// refuse: R024 4
model SmoothOfAnInteger "smooth of an Integer"
  Integer x = smooth(0, integer(time));
end SmoothOfAnInteger;
