// section: 3.7.1
// refuse: R050 4
model OptionsOfStringByPosition "the options of String are not given by position"
  parameter String s = String(5.0, 3);
end OptionsOfStringByPosition;
