// section: 11.1.2
// value: h[1] at 0.2 = 1, h[1] = 3, h[2] = 2
model ElementAtAnEvent "The array is the algorithm's as a whole: the other element keeps what it starts with"
  Real h[2](start = {1, 2});
algorithm
  when time > 0.5 then
    h[1] := 3;
  end when;
end ElementAtAnEvent;
