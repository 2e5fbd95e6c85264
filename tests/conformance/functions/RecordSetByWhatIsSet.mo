// section: 12.6
// value: y[1].a at 0 = 13, y[1].n at 0 = 5, y[2].a at 0 = 100, y[2].b at 0 = 0, y[2].n at 0 = 7, y[3].n at 0 = 2
// value: y[1].a = 1, y[2].a = 1, y[2].b = 1, y[2].n = 5, y[3].a = 100, y[3].b = 0, y[3].n = 7
model RecordSetByWhatIsSet "Subscripts that the assignment changes are those before it"
  record R
    Boolean b;
    Real a;
    Integer n;
  end R;
  function counted
    output R s = R(false, 100, 7);
    output Integer n = 0;
    input Integer last;
  algorithm
    while n < last loop
      n := n + 1;
    end while;
  end counted;
  function f
    input Integer k;
    output R y[3];
  algorithm
    y := {R(true, 1, 3), R(false, 2, 1), R(true, 3, 2)};
    y[k] := y[y[k].n];
    y[y[2].n].a := y[k].a + 10;
    (y[y[k].n], y[k].n) := counted(5);
  end f;
  Integer k = if time > 0.5 then 2 else 1;
  R y[3] = f(k);
end RecordSetByWhatIsSet;
