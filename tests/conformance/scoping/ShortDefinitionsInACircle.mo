// section: 5.6
// refuse: R011 5
model ShortDefinitionsInACircle "short definitions end at one that is none"
  package P
    package A = B;
    package B = A;
  end P;
  Real x = P.A.c;
end ShortDefinitionsInACircle;
