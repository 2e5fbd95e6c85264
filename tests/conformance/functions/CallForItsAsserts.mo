// section: 12.4.4
// value: x = 1
model CallForItsAsserts
  function check
    input Real a;
  algorithm
    assert(a >= 0, "negative");
  end check;
  Real x = time;
equation
  check(x);
end CallForItsAsserts;
