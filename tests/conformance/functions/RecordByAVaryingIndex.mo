// section: 12.6
// value: y = 14, y at 0 = 5
model RecordByAVaryingIndex
  record R
    Real a;
    Real v[2];
  end R;
  function f
    input R r[:];
    input Real u;
    output Real y;
  protected
    Integer k = 1;
    R one;
  algorithm
    while k < size(r, 1) and u > r[k].a loop
      k := k + 1;
    end while;
    one := r[k];
    y := one.v[1] + r[k].v[2];
  end f;
  parameter R r[2] = {R(0, {2, 3}), R(1, {6, 8})};
  Real y = f(r, 1.2*time);
end RecordByAVaryingIndex;
