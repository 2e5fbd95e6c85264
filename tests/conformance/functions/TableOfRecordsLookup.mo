// section: 12
// value: y = 25, z = 30
model TableOfRecordsLookup
  record Point
    Real x;
    Real y;
  end Point;
  function find
    input Point table[:];
    input Real u;
    output Real y;
  protected
    Integer k = 1;
  algorithm
    while k < size(table, 1) - 1 and u > table[k + 1].x loop
      k := k + 1;
    end while;
    y := table[k].y + (table[k + 1].y - table[k].y)*(u - table[k].x)/(table[k + 1].x - table[k].x);
  end find;
  parameter Point t[3] = {Point(0, 0), Point(1, 10), Point(2, 40)};
  Real y = find(t, 1.5);
  Real z = find(t, 1 + 2/3*time);
end TableOfRecordsLookup;
