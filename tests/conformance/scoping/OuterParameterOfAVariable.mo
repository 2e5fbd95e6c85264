// section: 5.4
// refuse: R076 7
model OuterParameterOfAVariable
  inner Real k = time;
  model User
    Real y = k*time;
    outer parameter Real k;
  end User;
  User user;
end OuterParameterOfAVariable;
