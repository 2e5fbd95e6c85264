// section: 12.2
// value: y = 3
model AttributesOfWhatIsDeclared "they may follow inputs; an Integer serves as a Real"
  type Level = enumeration(low, high);
  function f
    input Real u(min=0, max=n, unit="m", quantity="Length");
    input Integer n = 3;
    input Level level(min=Level.low, start=Level.high) = Level.low;
    output Real y(min=2*u, start=1, fixed=true, nominal=10, displayUnit="mm", stateSelect=StateSelect.never);
  protected
    Real v[n](each min=0, max={1, 2, 30});
  algorithm
    v := fill(u, n);
    y := sum(v);
  end f;
  Real y = f(time);
end AttributesOfWhatIsDeclared;
