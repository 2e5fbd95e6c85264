within Lacuna.Interfaces;
connector PositivePin "Electrical pin; the positive one of a pair"
  Types.Voltage v "Potential at the pin";
  flow Types.Current i "Current into the component that owns the pin";
  annotation(Documentation(info="<html>
<p>Connected pins share one potential and their currents sum to zero. Every circuit needs one
<code>Electrical.Ground</code>.</p>
</html>"));
end PositivePin;
