// section: 4.9.1
// refuse: R020 4
model DisplayUnitThatIsANumber "a displayUnit that is a number"
  Real x(displayUnit=1) = 1;
end DisplayUnitThatIsANumber;
