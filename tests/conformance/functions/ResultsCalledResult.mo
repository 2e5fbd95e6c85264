// section: 12.4
// value: scaled[1] = 0.75, scaled[3] = 0.5, halved[1] = 0.75, halved[2] = 0.25
model ResultsCalledResult "Names that the generated code uses as well"
  function scale
    input Real v[3];
    input Real factor;
    output Real result[3];
  algorithm
    result := v*factor;
    while result[1] > 1 loop
      result := result/2;
    end while;
  end scale;
  function halve
    input Real result[2];
    output Real y[2];
  algorithm
    y := result;
    while y[1] > 1 loop
      y := y/2;
    end while;
  end halve;
  Real scaled[3] = scale({3*time,1,2}, 2);
  Real halved[2] = halve({3*time, 1});
end ResultsCalledResult;
