// section: 10.4.1
// value: A[1,2] = 21, A[3,1] = 13
model IteratorOrder "the first iterator runs over the columns"
  Real A[3, 2] = {i + 10*j - 0*time for j in 1:2, i in 1:3} ;
end IteratorOrder;
