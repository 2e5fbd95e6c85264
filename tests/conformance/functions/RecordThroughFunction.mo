// section: 12.6
// value: l = 5
model RecordThroughFunction
  record Point
    Real x;
    Real y;
  end Point;
  function length
    input Point p;
    output Real l;
  algorithm
    l := sqrt(p.x^2 + p.y^2);
  end length;
  Real l = length(Point(3*time, 4*time));
end RecordThroughFunction;
