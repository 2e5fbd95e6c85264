// section: 12.2
// refuse: R015 10
model PartialCalled
  partial function f
    input Real a;
    output Real b;
  algorithm
    b := a;
  end f;
  Real x = f(time);
end PartialCalled;
