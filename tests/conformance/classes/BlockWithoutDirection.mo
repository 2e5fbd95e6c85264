// section: 4.7
// refuse: R070 9
model BlockWithoutDirection
  connector C
    Real e;
    flow Real f;
  end C;
  block B
    C c;
  end B;
  B b;
end BlockWithoutDirection;
