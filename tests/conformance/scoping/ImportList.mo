// section: 13.2.1
// value: y = 6
model ImportList
  encapsulated package P
    constant Real a = 1;
    constant Real b = 2;
    constant Real c = 3;
  end P;
  import ImportList.P.{b, c};
  Real y = b*c;
end ImportList;
