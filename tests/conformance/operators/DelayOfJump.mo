// section: 3.7.5
// value: y at 0.6 = 0, y at 0.8 = 1
model DelayOfJump "a jump comes out as late"
  Real u = if time >= 0.3 then 1 else 0, y = delay(u, 0.4);
end DelayOfJump;
