// section: 17.1
// refuse: R091 9
model TransitionOfAStateMachine
  block A
    Real x = 1;
  end A;
  A a, b;
equation
  transition(a, b, time > 0.5);
  initialState(a);
end TransitionOfAStateMachine;
