// section: 12.4.1
// value: y = 1
model RecordAlike "a record of another name with the same fields is of the type of the input"
  record Point
    Real x;
  end Point;
  record Place
    Real x;
  end Place;
  function reach input Point p; output Real r = abs(p.x); algorithm
  end reach;
  Place place(x = time);
  Real y = reach(place);
end RecordAlike;
