// section: 12.6
// value: p.x = 2, p.y = 3
model RecordFromFunction
  record Point
    Real x;
    Real y;
  end Point;
  function point
    input Real a;
    output Point p;
  algorithm
    p.x := 2*a;
    p.y := 3*a;
  end point;
  Point p = point(time);
end RecordFromFunction;
