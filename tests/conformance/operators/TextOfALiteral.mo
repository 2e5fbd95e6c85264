// section: 3.7.1
// value: a = true
model TextOfALiteral
  type E = enumeration(one, two);
  Boolean a = String(E.two) == "two";
end TextOfALiteral;
