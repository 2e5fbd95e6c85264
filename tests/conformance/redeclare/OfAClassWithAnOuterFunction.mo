// section: 5.4
// value: a.c.x = 2, a.c.y = 20
model OfAClassWithAnOuterFunction "a component redeclared by a class that inherits an outer function and an outer package"
  function one
    output Real k = 1;
  algorithm
  end one;
  function two
    output Real k = 2;
  algorithm
  end two;
  package Ten
    constant Real k = 10;
  end Ten;
  package Twenty
    constant Real k = 20;
  end Twenty;
  model Chain
    outer function f = one;
    outer package Q = Ten;
    Real x = f()*time;
    Real y = Q.k*time;
  end Chain;
  model Group
    inner function f = two;
    inner package Q = Twenty;
    replaceable Chain c;
  end Group;
  model Long
    extends Chain;
  end Long;
  Group a(redeclare Long c);
end OfAClassWithAnOuterFunction;
