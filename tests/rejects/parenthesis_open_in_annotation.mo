// code: P003
// line: 6
// hint: before ';'
package P
  model M
    Real x annotation(Placement(transformation(extent={{0,0},{1,1}}));
  equation
    x = 1;
  end M;
  model Other
    Real y = 2;
  end Other;
end P;
