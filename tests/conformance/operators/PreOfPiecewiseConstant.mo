// section: 3.7.5
// refuse: R052 11
model PreOfPiecewiseConstant
  discrete Real xd1(start = 0, fixed = true);
  Real xc3, y;
equation
  when sample(0.25, 0.25) then
    xd1 = pre(xd1) + 1;
  end when;
  xc3 = xd1 + 1;
  y = pre(xc3);
end PreOfPiecewiseConstant;
