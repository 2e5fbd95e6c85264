// section: 3.7.1
// value: a = true, b = true, c = true, d = true
model TextOfNumbers
  Boolean a = String(111.222) == "111.222";
  Boolean b = String(3.14159265, significantDigits=4) == "3.142";
  Boolean c = String(42) == "42" and String(true) == "true";
  Boolean d = String(5.2353535345, format="2.6f") == "5.235354";
end TextOfNumbers;
