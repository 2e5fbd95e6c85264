// section: 3.7.4.8
// value: a.x = 1
model InstanceName
  model A
    Real x = if getInstanceName() == "InstanceName.a" then 1 else 2;
  end A;
  A a;
end InstanceName;
