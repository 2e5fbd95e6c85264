// section: 7.4
// refuse: R032 9
model ParameterLeftOut "a parameter is no component to leave out"
  model A
    parameter Real p = 1;
    Real x = 2;
  end A;
  model B
    extends A(break p);
  end B;
  B b;
end ParameterLeftOut;
