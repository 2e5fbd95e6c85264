// section: 8.3.5
// refuse: R020 6
model MatrixOfConditions "when over a matrix of conditions"
  Integer n(start=0, fixed=true);
equation
  when [time > 0.5, time > 0.6] then
    n = pre(n) + 1;
  end when;
end MatrixOfConditions;
