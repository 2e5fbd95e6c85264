// section: 7.2.5
// refuse: R036 4
model EachWithAnArray
  Real fail1[2](each start = {1, 2});
equation
  der(fail1) = {1, 1};
end EachWithAnArray;
