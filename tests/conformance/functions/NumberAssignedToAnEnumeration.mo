// section: 4.9.5
// refuse: R025 9
model NumberAssignedToAnEnumeration
  type E = enumeration(a, b);
  function f
    input Real x;
    output E e;
  algorithm
    e := 2;
  end f;
  E z = f(time);
end NumberAssignedToAnEnumeration;
