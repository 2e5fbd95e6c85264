// section: 12.4
// value: z = 5, w = 1
model EnumerationAsAResult "Chosen by what varies"
  type M = enumeration(low, high);
  function classify
    input Real x;
    input Boolean invert = false;
    output M m;
    output Boolean b;
  algorithm
    m := if x > 0.5 then M.high else M.low;
    b := (m == M.high) <> invert;
  end classify;
  M m;
  Boolean b;
  Real z = if m == M.high then 5 else 1;
  Real w = if b then 0 else 1;
equation
  when sample(0.1, 0.1) then
    (m, b) = classify(time, true);
  end when;
end EnumerationAsAResult;
