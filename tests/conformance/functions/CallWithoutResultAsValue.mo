// section: 12.4.4
// refuse: R004 9
model CallWithoutResultAsValue
  function check
    input Real a;
  algorithm
    assert(a >= 0, "negative");
  end check;
  Real x = check(time);
end CallWithoutResultAsValue;
