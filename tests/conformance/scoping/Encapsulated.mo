// section: 5.3.1
// refuse: R002 6
model Encapsulated
  constant Real g = 4;
  encapsulated model A
    Real y = g;
  end A;
  A a;
end Encapsulated;
