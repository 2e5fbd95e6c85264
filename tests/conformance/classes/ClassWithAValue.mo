// section: 7.2
// refuse: R032 9
model ClassWithAValue "a class has no value: the slip is one of capital letters"
  model Loop
    type Set = Real(unit="m");
    parameter Set set = 1;
    Real x = set*time;
  end Loop;
  Loop a(Set=50);
end ClassWithAValue;
