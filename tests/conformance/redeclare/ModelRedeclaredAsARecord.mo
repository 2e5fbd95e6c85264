// section: 7.3
// refuse: R034 14
model ModelRedeclaredAsARecord "a model redeclared as a record"
  model M
    Real x = 1;
  end M;
  record R
    Real x = 1;
  end R;
  model D
    replaceable model L = M;
    L m;
  end D;
  D d(redeclare record L = R);
end ModelRedeclaredAsARecord;
