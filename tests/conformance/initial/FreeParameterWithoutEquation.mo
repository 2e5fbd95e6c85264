// section: 8.6
// refuse: S023 4
model FreeParameterWithoutEquation "a parameter that is to be found, without an equation"
  parameter Real p(fixed=false);
  Real x = p;
end FreeParameterWithoutEquation;
