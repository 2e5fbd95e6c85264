// section: A.2.2
// refuse: P021 3
expandable model ExpandableModel
  Real x = 1;
end ExpandableModel;
