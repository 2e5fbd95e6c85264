// section: 12.6.1
// value: rec1.r1 = 4, rec2[2].i2 = 6, rec1.sub1.flange.tau = 0
connector Flange
  Real phi;
  flow Real tau;
end Flange;
model Model1
  Real m1 = 3;
  Boolean b1 = true;
  Flange flange(phi = 2*time);
end Model1;
model Model2
  Real r1 = 4;
  Real r2 = 5;
  Integer i2 = 6;
  Model1 sub1;
end Model2;
record MyFlange
  Real tau;
end MyFlange;
record MyRecord1
  Boolean b1;
  MyFlange flange;
end MyRecord1;
record MyRecord2
  Real r1;
  Integer i2;
  MyRecord1 sub1;
end MyRecord2;
model RecordOfAComponent
  Model2 s1;
  Model2 s2[2];
  MyRecord2 rec1 = MyRecord2(s1);
  MyRecord2 rec2[2] = MyRecord2(s2);
end RecordOfAComponent;
