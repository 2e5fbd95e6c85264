// section: 3.6.5
// value: n = 1
model StringChosenByParameter
  parameter Boolean onFile = false;
  parameter String name = "NoName";
  final parameter String used = if onFile and name <> "NoName" then name else "NoName";
  Real x[if used == "NoName" then 1 else 2] = {time};
  Integer n = size(x, 1);
end StringChosenByParameter;
