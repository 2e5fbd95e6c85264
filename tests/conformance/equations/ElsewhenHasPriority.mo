// section: 8.3.5
// value: n = 1
model ElsewhenHasPriority "of two conditions that become true together the first counts"
  Integer n(start=0, fixed=true);
equation
  when time > 0.5 then
    n = 1;
  elsewhen time >= 0.5 and time > 0.5 then
    n = 2;
  end when;
end ElsewhenHasPriority;
