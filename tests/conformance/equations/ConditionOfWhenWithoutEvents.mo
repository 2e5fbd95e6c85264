// section: 8.3.5
// refuse: R063 6
model ConditionOfWhenWithoutEvents "the condition of when is discrete"
  Integer n(start=0, fixed=true);
equation
  when noEvent(time > 0.5) then
    n = pre(n) + 1;
  end when;
end ConditionOfWhenWithoutEvents;
