// section: 5.3
// refuse: R004 10
model FunctionInABranchNotTaken "what a function does not do for these arguments names what there is"
  function f
    input Real x;
    input Integer kind;
    output Real y;
  algorithm
    if kind == 2 then
      y := squared(x);
    else
      y := x;
    end if;
  end f;
  Real x = f(time, 1);
end FunctionInABranchNotTaken;
