// section: 11.2.2
// refuse: R058 8
model LoopVariableAssigned
  function f
    output Real y = 0;
  algorithm
    for i in 1:2 loop
      i := 3;
    end for;
  end f;
  Real y = f();
end LoopVariableAssigned;
