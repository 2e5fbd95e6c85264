// section: 3.5
// value: n = 1
model ChosenString
  String s = if time > 0.5 then "late" else "early";
  Integer n = if s == "late" then 1 else 0;
end ChosenString;
