// section: 3.6.5
// value: r[1].a = 4, r[2].b = 4, larger.c = 9
model ChosenArrayOfRecords "arrays of records while the model runs; records that differ, by a condition known before"
  record R
    Real a;
    Real b;
  end R;
  record Larger
    extends R;
    Real c = 9;
  end Larger;
  R pair[2] = {R(1, 2), R(3, 4)};
  R other[2] = {R(4, 3), R(3, 4)};
  R r[2] = if time > 0.5 then other else pair;
  parameter Integer n = 2;
  Larger larger = if n > 1 then Larger(1, 2) else R(1, 2);
end ChosenArrayOfRecords;
