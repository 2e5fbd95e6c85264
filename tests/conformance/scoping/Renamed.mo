// section: 13.2.1
// value: y = 2
model Renamed
  encapsulated package P
    constant Real b = 2;
  end P;
  import Q = Renamed.P;
  Real y = Q.b;
end Renamed;
