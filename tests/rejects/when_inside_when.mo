// code: R057
// line: 8
// hint: combine
model M
  discrete Real x(start = 0);
equation
  when time > 1 then
    when time > 2 then
      x = 1;
    end when;
  end when;
end M;
