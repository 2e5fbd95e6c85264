// section: 11.2.3
// value: y = 6
model WhileInside
  function digits
    input Real x;
    output Integer n;
  protected
    Real rest;
  algorithm
    n := 0;
    rest := x;
    while rest >= 1 loop
      rest := rest/10;
      n := n + 1;
    end while;
  end digits;
  Real y = digits(123456*max(time, 0.9));
end WhileInside;
