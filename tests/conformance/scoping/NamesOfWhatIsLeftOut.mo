// section: 5.3
// value: y at 1 = 1, z at 1 = 6
model NamesOfWhatIsLeftOut "what is left out may name loop variables, literals, functions, constants and what is not there"
  package P
    constant Real k = 2;
    function f
      input Real x;
      input Real a[:] = {1, 2};
      output Real y;
    protected
      Real w;
    algorithm
      y := x;
      if size(a, 1) > 5 then
        for i in 1:size(a, 1), j loop w := sum(a[l] for l in 1:i) + a[j] + k; end for;
        y := w + k;
      end if;
    end f;
  end P;
  type Kind = enumeration(small, large);
  connector C
    Real e;
    flow Real f;
  end C;
  model Part
    C c;
    parameter Boolean more = false;
    C d if more;
    outer Real z;
  equation
    c.e = time;
    if more then
      connect(c, d);
      assert(z > P.f(c.e) + P.k and Kind.small < Kind.large and initial(), "never", AssertionLevel.warning);
    end if;
  end Part;
  Part part;
  inner Real z = 6;
  Real y;
equation
  y = if false then P.f(part.c.f) else part.c.e;
  for b in Boolean loop assert(b or not b, "never"); end for;
  for i in 1:0 loop
    for j in Kind loop
      y = if j == Kind.small then {{i*k for k in 1:i}} * P.f(x = 2) else time;
    end for;
  end for;
end NamesOfWhatIsLeftOut;
