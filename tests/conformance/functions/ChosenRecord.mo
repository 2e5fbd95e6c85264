// section: 3.6.5
// value: r.a = 3, r.b = 4
model ChosenRecord "an if-expression of records"
  record R
    Real a;
    Real b;
  end R;
  R r = if time > 0.5 then R(3, 4) else R(1, 2);
end ChosenRecord;
