// section: 3.5
// value: n = 1, m = 0, k = 1
model StringsAtRunTime
  Boolean b = time > 0.5;
  String s, t = "x" + s;
  Integer n = if t == "xon" then 1 else 0;
  Integer m = if t <> "xon" then 1 else 0;
  Integer k(start=0, fixed=true);
  function name
    input Boolean b;
    output String s;
  algorithm
    if b then
      s := "on";
    else
      s := "off";
    end if;
  end name;
equation
  s = name(b);
  when s == "on" then
    k = pre(k) + 1;
  end when;
  assert(s == "on" or s == "off", "s is " + s);
end StringsAtRunTime;
