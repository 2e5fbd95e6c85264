// section: 12.4.6
// value: s = 6, t = 5
model ArrayOfRecords "records in an array: elements and slices of their fields"
  record P
    Real x;
    Real y;
  end P;
  function total
    input P p[:];
    output Real s;
  algorithm
    s := 0;
    for i in 1:size(p, 1) loop
      s := s + p[i].x + p[i].y;
    end for;
  end total;
  Real s = total({P(time, 2), P(3, 0)});
  P list[2] = {P(1, 2), P(3, 3)};
  Real t = sum(list.y);
end ArrayOfRecords;
