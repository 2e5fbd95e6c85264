// section: 16.2
// refuse: R091 7
model ClockedWhen
  Real x;
equation
  when Clock(0.1) then
    x = previous(x) + 1;
  end when;
end ClockedWhen;
