// section: 4.7
// refuse: R070 5
model RecordInput
  record R
    input Real x = 1;
  end R;
  R r;
end RecordInput;
