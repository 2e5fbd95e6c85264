// section: 2.4.2
// refuse: P018 4
model UnknownEscape
  parameter String s = "a\qb";
end UnknownEscape;
