// section: 8.3.5.3
// value: x = 1
model FirstBranchOfTwo
  discrete Real x(start=0, fixed=true);
equation
  when time > 0.5 then
    x = 1;
  elsewhen time > 0.5 then
    x = 2;
  end when;
end FirstBranchOfTwo;
