// section: 12.4.4
// value: y = 3
model SizeFromALocal
  function f
    input Real u[:];
    input Real limit;
    output Real y = 0;
  protected
    Integer nu = size(u, 1);
    Real v[nu];
    Real s = 0;
  algorithm
    v := u - fill(1, nu);
    while s < limit loop
      s := s + 1;
      y := y + v[1];
    end while;
  end f;
  Real y = f({2, 3}, 2.5*time);
end SizeFromALocal;
