// section: 7.2.6
// refuse: R031 9
model PartOfAFinalElement "all parts of a final element are final, its attributes among them"
  model A
    final Real x(start=1, fixed=true);
  equation
    der(x) = 0;
  end A;
  A a(x(start=2));
end PartOfAFinalElement;
