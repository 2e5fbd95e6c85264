// section: 4.8
// value: a.x[1] = 6, a.x[2] = 5, a.x[3] = 4
model AssignedTogetherInAComponent "a register that is shifted at events is as balanced in a component as in a model"
  model Register
    Integer x[3](each start = 0, each fixed = true);
    Integer k(start = 1, fixed = true);
  algorithm
    when sample(0.1, 0.2) then
      k := pre(k) + 1;
      x := cat(1, {k}, x[1:end - 1]);
    end when;
  end Register;
  Register a;
end AssignedTogetherInAComponent;
