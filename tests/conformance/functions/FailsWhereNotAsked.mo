// section: 11.2.6
// value: y = 1
model FailsWhereNotAsked
  function never
    output Real y;
  algorithm
    assert(false, "called");
    y := 0;
  end never;
  parameter Boolean wanted = false;
  Real y = if wanted then never() else 1;
end FailsWhereNotAsked;
