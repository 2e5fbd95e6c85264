// section: 4.7
// refuse: R071 6
class Whole
  Integer i;
end Whole;
type Part = Whole;
model TypeOfAModel
  Part p;
equation
  p.i = 1;
end TypeOfAModel;
