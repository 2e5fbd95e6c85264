// section: 3.8
// refuse: R063 11
model IntegerOfWhatVaries
  function f
    input Real x;
    output Integer y;
  algorithm
    y := integer(x);
  end f;
  Real x = time;
  Integer y = f(x);
end IntegerOfWhatVaries;
