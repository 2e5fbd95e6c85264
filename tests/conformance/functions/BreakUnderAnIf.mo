// section: 11.2.4
// refuse: R059 10
model BreakUnderAnIf "of no loop"
  function f
    input Real u;
    output Real y;
  algorithm
    y := u;
    if u > 0 then
      break;
    end if;
  end f;
  Real x = f(1);
end BreakUnderAnIf;
