// section: 3.7.1
// refuse: R050 4
model TextInAWrongFormat
  Boolean a = String(7, format="z") == "7";
end TextInAWrongFormat;
