// section: 3.7.1
// value: a = true, b = true
model TextPadded
  Boolean a = String(7, minimumLength=3) == "7  ";
  Boolean b = String(7, minimumLength=3, leftJustified=false) == "  7";
end TextPadded;
