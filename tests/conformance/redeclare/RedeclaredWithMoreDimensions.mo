// section: 7.3
// refuse: R034 7
model RedeclaredWithMoreDimensions "a redeclaration with another number of dimensions"
  model C
    replaceable Real x = 1;
  end C;
  C c(redeclare Real x[2] = {1, 2});
end RedeclaredWithMoreDimensions;
