// section: 8.3.5
// refuse: R058 8
model LeftSideInWhen "what is set in a when-equation stands alone on its left"
  discrete Real x(start=0);
  Real y = time;
equation
  when time > 0.5 then
    2*y = x;
  end when;
end LeftSideInWhen;
