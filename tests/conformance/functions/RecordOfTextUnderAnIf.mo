// section: 12.6
// value: x = 2, n = 4
model RecordOfTextUnderAnIf "the String of a record is chosen by an if-statement over a parameter"
  record R
    Real t;
    String c = "raw";
  end R;
  function f
    input R y[:];
    input Boolean b;
    output R z[size(y, 1)] = y;
  algorithm
    if b then
      z[1] := y[2];
    end if;
  end f;
  parameter Boolean b = true;
  parameter R s[2] = f({R(1), R(2, "blue")}, b);
  Real x = s[1].t*time;
  parameter Integer n = if s[1].c == "blue" then 4 else 3;
end RecordOfTextUnderAnIf;
