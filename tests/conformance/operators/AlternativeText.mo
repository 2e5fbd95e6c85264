// section: 6.7
// refuse: R021 4
model AlternativeText "alternatives are type compatible, whichever is chosen"
  Real x = if true then 1 else "a";
end AlternativeText;
