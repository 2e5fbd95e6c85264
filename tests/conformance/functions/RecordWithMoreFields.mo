// section: 12.4.1
// refuse: R062 14
model RecordWithMoreFields "a record that has more fields is not of the type of the input: it would lose them unseen"
  record Point
    Real x;
  end Point;
  record Marked
    extends Point;
    Real mark;
  end Marked;
  function reach input Point p; output Real r = abs(p.x); algorithm
  end reach;
  Marked marked(x = time, mark = 1);
  Real y = reach(marked);
end RecordWithMoreFields;
