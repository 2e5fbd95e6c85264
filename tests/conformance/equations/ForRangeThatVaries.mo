// section: 8.3.3
// refuse: F021 6
model ForRangeThatVaries
  Real a[3];
equation
  for i in 1:integer(time + 3) loop
    a[i] = i;
  end for;
end ForRangeThatVaries;
