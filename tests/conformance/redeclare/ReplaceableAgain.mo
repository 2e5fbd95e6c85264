// section: 7.3
// value: m.a.x = 9
model ReplaceableAgain
  model M
    replaceable model A
      Real x = 1;
    end A;
    A a;
  end M;
  model Z
    Real x = 9;
    Real y = 3;
  end Z;
  M m(redeclare replaceable model A = Z);
end ReplaceableAgain;
