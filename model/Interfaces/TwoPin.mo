within Lacuna.Interfaces;
partial model TwoPin "Component with two pins and no other way for current to leave"
  Types.Voltage v "Voltage drop from p to n";
  Types.Current i "Current from p to n";
  PositivePin p "Positive pin";
  NegativePin n "Negative pin";
equation
  v = p.v - n.v;
  i = p.i;
  p.i + n.i = 0;
  annotation(Documentation(info="<html>
<p>Use it for every element that is described by a relation between <code>v</code> and <code>i</code>. Power
<code>v*i</code> is positive when the element takes energy up.</p>
</html>"));
end TwoPin;
