// section: 9.1
// refuse: F021 15
model SubscriptVaries
  connector I = input Real;
  connector O = output Real;
  block A
    O y = 1;
  end A;
  block B
    I u[2];
  end B;
  Integer k = if time > 0.5 then 1 else 2;
  A a; B b;
equation
  connect(a.y, b.u[k]);
end SubscriptVaries;
