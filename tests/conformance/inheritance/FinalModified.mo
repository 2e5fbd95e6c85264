// section: 7.2.6
// refuse: R031 7
model FinalModified
  model A
    final parameter Real k = 1;
  end A;
  A a(k=2);
end FinalModified;
