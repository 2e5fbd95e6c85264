// section: 12.4.5
// refuse: R042 9
model ArrayGrowsVaries
  function positive
    input Real x[:];
    output Real y[:];
  algorithm
    for i in 1:size(x, 1) loop
      if x[i] > 0 then
        y := cat(1, y, {x[i]});
      end if;
    end for;
  end positive;
  Real n = sum(positive({time, 1}));
end ArrayGrowsVaries;
