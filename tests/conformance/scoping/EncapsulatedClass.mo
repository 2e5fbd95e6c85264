// section: 5.3.1
// refuse: R001 6
model EncapsulatedClass
  type T = Real(min=0);
  encapsulated model A
    T y = 1;
  end A;
  A a;
end EncapsulatedClass;
