// section: 3.7.1
// value: a = 1, b = 1, c = 1, d = 1
model FormatsOfNumbers "the formats of Reals are for Integers, too; a Real is rounded for those of Integers"
  parameter Real a = if String(4, format = ".3f") == "4.000" then 1 else 0;
  parameter Real b = if String(65, format = "c") == "A" then 1 else 0;
  parameter Real c = if String(255, format = "x") == "ff" then 1 else 0;
  parameter Real d = if String(3.6, format = "d") == "4" then 1 else 0;
end FormatsOfNumbers;
