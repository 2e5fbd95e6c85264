// section: 5.6
// refuse: R011 4
model FunctionShortForItself "a short definition is of another class"
  function f = f;
  Real x = f(time);
end FunctionShortForItself;
