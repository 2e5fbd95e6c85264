// section: 4.9
// refuse: R074 4
model ReservedClass
  model Boolean
    Integer x = 1;
  end Boolean;
  Integer y = 2;
end ReservedClass;
