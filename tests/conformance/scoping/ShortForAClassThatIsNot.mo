// section: 4.5.1
// refuse: R001 8
model ShortForAClassThatIsNot "said where it is defined, not where it is used"
  package Held
    constant Real c = 1;
  end Held;

  package M = Held.Medium;
  M.State state;
  Real x = state.p;
end ShortForAClassThatIsNot;
