// section: 8.3.7
// value: x = 1
model MessageOfAnAssertThatHolds
  function text
    output String s;
  algorithm
    assert(false, "not to be evaluated");
    s := "text";
  end text;
  Real x = 1;
equation
  assert(true, text());
end MessageOfAnAssertThatHolds;
