// section: 7.2.7
// refuse: F023 5
model ParameterOfAPartTakenAway
  model A
    parameter Real x = 1;
    Real y = x*time;
  end A;
  A a(x = break);
end ParameterOfAPartTakenAway;
