// section: 3.5
// value: a = true, b = true, c = false, d = true
model StringsCompared "texts in the order of their characters"
  parameter String s = "abc", t = "abd";
  parameter Boolean a = s < t, b = s <> t, c = s == t, d = s + t == "abcabd";
  Real x = time;
end StringsCompared;
