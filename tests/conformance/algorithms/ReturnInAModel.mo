// section: 11.2.1
// refuse: R059 8
model ReturnInAModel
  Real y;
algorithm
  y := 1;
  if time > 2 then
    return;
  end if;
end ReturnInAModel;
