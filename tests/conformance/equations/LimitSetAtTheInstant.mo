// section: 8.5
// value: late = 0, ok = 1, early = 0, soon = 1, below at 0.9 = 0, below at 1 = 1
model LimitSetAtTheInstant "A relation with what the when-clause sets, of time and of a state, used outside of it, too"
  discrete Real lim(start = -1, fixed = true), door(start = -1, fixed = true);
  Integer late(start = 0, fixed = true), ok(start = 0, fixed = true);
  Integer early(start = 0, fixed = true), soon(start = 0, fixed = true);
  Boolean open = time < door;
  Boolean below = h < lim;
  Real h(start = 0, fixed = true);
equation
  der(h) = 1;
  when sample(0.95, 10) then
    lim = h + 3;
    door = time + 3;
    if h >= lim then
      late = 1;
      ok = 0;
    else
      late = 0;
      ok = 1;
    end if;
    if not open then
      early = 1;
      soon = 0;
    else
      early = 0;
      soon = 1;
    end if;
  end when;
end LimitSetAtTheInstant;
