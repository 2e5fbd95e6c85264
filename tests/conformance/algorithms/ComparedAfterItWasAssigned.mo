// section: 11.2
// value: late = 0, ok = 1, open = 1
model ComparedAfterItWasAssigned "The same relation is used outside of the algorithm, where it makes an event"
  discrete Real door(start = -1, fixed = true);
  Integer late(start = 0, fixed = true), ok(start = 0, fixed = true);
  Boolean open = time < door;
algorithm
  when sample(0.5, 10) then
    door := time + 3;
    if time >= door then
      late := 1;
    else
      ok := 1;
    end if;
  end when;
end ComparedAfterItWasAssigned;
