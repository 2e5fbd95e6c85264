// section: 12.6
// value: r.b[1] = 1, r.b[2] = 7, r.n = 4
model RecordWithAnArray "a record result whose array is assigned whole, then by element"
  record R
    Real b[3];
    Integer n;
  end R;
  function make
    input Real x;
    output R r;
  algorithm
    r.b := {x, 2*x, 3*x};
    r.b[2] := 7;
    r.n := 4;
  end make;
  R r = make(time);
end RecordWithAnArray;
