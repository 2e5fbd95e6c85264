// section: 4.4.2.2
// refuse: R072 11
model InputOfInput
  record R
    Real x;
  end R;
  connector C
    input Real u;
  end C;
  block B
    input C c;
  end B;
  B b;
end InputOfInput;
