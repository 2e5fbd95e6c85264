// section: 10.5
// value: x at 0 = 5, x = 1, y at 0 = 2, y = 5, z[1] at 0 = 2, z[2] at 0 = 2, z[1] = 7, z[2] = 4
model PartOfAnArrayByAVaryingIndex "The subscript counts in the part, not in the array that it is of"
  record R
    Real m[2];
  end R;
  function ofAPart
    input Real v[3];
    input Integer k;
    output Real y = 0;
  algorithm
    while y < 0.5 loop
      y := (v[{3, 1}])[k];
    end while;
  end ofAPart;
  function picked
    input Real v[2];
    input Integer k;
    output Real y = v[k];
  end picked;
  function ofAnArgument
    input Real v[3];
    input Integer k;
    output Real y = 0;
  algorithm
    while y < 0.5 loop
      y := picked(v[2:3], k);
    end while;
  end ofAnArgument;
  function ofRecords
    input R r[:];
    input Integer k;
    output Real y[2];
  protected
    Integer j = 1;
  algorithm
    while j < k loop
      j := j + 1;
    end while;
    y := r[j].m;
    y[1] := y[1] + r[j].m[j];
  end ofRecords;
  Integer k = if time > 0.5 then 2 else 1;
  Real x = ofAPart({1, 2, 5}, k);
  Real y = ofAnArgument({1, 2, 5}, k);
  Real z[2] = ofRecords({R({1, 2}), R({3, 4})}, k);
end PartOfAnArrayByAVaryingIndex;
