// section: 7.3
// value: h.y = 8
model Function
  function twice
    input Real x;
    output Real y = 2*x;
  algorithm
  end twice;
  function four
    input Real x;
    output Real y = 4*x;
  algorithm
  end four;
  model H
    replaceable function f = twice;
    Real y = f(2);
  end H;
  H h(redeclare function f = four);
end Function;
