// section: 5.4
// refuse: R003 12
model OuterLacksAnElement "The inner one has it, the type of the outer declaration has not"
  partial record R
    Real i;
  end R;
  record S
    extends R;
    Real a;
  end S;
  model User
    Real x = settings.a*time;
    outer R settings;
  end User;
  inner S settings(i = 1, a = 2);
  User user;
end OuterLacksAnElement;
