// section: 7.3
// value: p.q.g = 3
model PackageHandedOn
  package A
    constant Real g = 1;
  end A;
  package B
    constant Real g = 3;
  end B;
  model Inner
    replaceable package M = A;
    Real g = M.g;
  end Inner;
  model Outer
    replaceable package M = A;
    Inner q(redeclare package M = M);
  end Outer;
  Outer p(redeclare package M = B);
end PackageHandedOn;
