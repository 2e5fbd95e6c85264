// section: 4.5.1
// refuse: R015 12
connector C
  replaceable Real x;
  flow Real f;
end C;
model ShortForPartial
  partial model Q
    Real x = 1;
  end Q;
  model R = Q;
  R r;
end ShortForPartial;
