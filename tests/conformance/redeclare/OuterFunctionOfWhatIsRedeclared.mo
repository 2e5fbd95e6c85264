// section: 5.4
// value: a.c.x = 2
model OuterFunctionOfWhatIsRedeclared "inner classes are looked for around the component that is redeclared"
  function one
    output Real k = 1;
  algorithm
  end one;
  function two
    output Real k = 2;
  algorithm
  end two;
  model Chain
    outer function f = one;
    Real x = f()*time;
  end Chain;
  model Group
    inner function f = two;
    replaceable Chain c;
  end Group;
  model Longer
    extends Chain;
  end Longer;
  Group a(redeclare Longer c);
end OuterFunctionOfWhatIsRedeclared;
