// section: 2.2
// refuse: P002 4
model CommentWithoutEnd
  Real x = 1; /* it goes on
end CommentWithoutEnd;
