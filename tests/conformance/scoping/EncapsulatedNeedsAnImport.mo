// section: 5.3.1
// refuse: R001 8
model EncapsulatedNeedsAnImport
  record Z
    Real re;
  end Z;
  encapsulated model M
    Z z(re = 1);
  end M;
  M m;
end EncapsulatedNeedsAnImport;
