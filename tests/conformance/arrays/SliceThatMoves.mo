// section: 10.5
// value: y[2] at 0.4 = 0.8, y[1] = 2, y[2] = 3
model SliceThatMoves
  Integer k(start=1);
  Real x[3] = {time, 2*time, 3*time}, y[2] = x[k:k + 1];
equation
  when time > 0.5 then
    k = 2;
  end when;
end SliceThatMoves;
