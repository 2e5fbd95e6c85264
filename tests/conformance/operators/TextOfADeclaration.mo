// section: 3.7.1
// value: n = 1
model TextOfADeclaration
  Integer i = 4;
  String s = String(i + 1);
  Integer n = if s == "5" then 1 else 0;
end TextOfADeclaration;
