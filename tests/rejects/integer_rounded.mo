// code: P030
// line: 5
// hint: write a Real
model integer_rounded
  Integer n = 9007199254740993;
end integer_rounded;
