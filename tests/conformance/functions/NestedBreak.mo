// section: 11.2.4
// value: n = 5
model NestedBreak "break ends the loop that it stands in"
  function f
    output Integer n = 0;
  algorithm
    for i in 1:5 loop
      for j in 1:5 loop
        if j > i then
          break;
        end if;
        n := n + 1;
      end for;
      if i == 2 then
        n := n + 2;
        break;
      end if;
    end for;
  end f;
  Integer n = f();
end NestedBreak;
