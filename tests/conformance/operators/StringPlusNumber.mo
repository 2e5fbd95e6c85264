// section: 10.6.1
// refuse: R021 4
model StringPlusNumber
  parameter String s = "a" + 1;
end StringPlusNumber;
