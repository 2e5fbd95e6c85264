// section: 3.7.1
// value: n = 1, m = 1, k = 2
model TextOfWhatVaries
  type E = enumeration(one, two);
  E e(start=E.one, fixed=true);
  Boolean b = time > 0.5;
  Integer n = if String(e) == "one" then 1 else 2;
  Integer m = if String(b) == "true" then 1 else 0;
  Integer k(start=1, fixed=true);
equation
  when time > 2 then
    e = E.two;
  end when;
  when time > 0.3 then
    k = if "is " + String(e) == "is two" then 7 else 2;
  end when;
end TextOfWhatVaries;
