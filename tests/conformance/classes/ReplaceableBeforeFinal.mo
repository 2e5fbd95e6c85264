// section: A.2.3
// refuse: P021 4
model ReplaceableBeforeFinal
  replaceable final parameter Real x = 1;
end ReplaceableBeforeFinal;
