// section: 10.3.4, 14.4
// value: s.x = 8, p.x = 11, m[2].x = 25
package Numbers
  operator record Q
    Real x;
    encapsulated operator function '+'
      import Numbers.Q;
      input Q a;
      input Q b;
      output Q c;
    algorithm
      c := Q(a.x + b.x);
    end '+';
    encapsulated operator function '*'
      import Numbers.Q;
      input Q a;
      input Q b;
      output Q c;
    algorithm
      c := Q(a.x*b.x);
    end '*';
  end Q;
end Numbers;
model SumOfOperatorRecords "sums and products of vectors and matrices, by '+' and '*' of the elements"
  import Numbers.Q;
  Q s = sum({Q(5), Q(3)});
  Q p = {Q(1), Q(2)}*{Q(3), Q(4)};
  Q m[2] = {{Q(1), Q(2)}, {Q(3), Q(4)}}*{Q(3), Q(4)};
end SumOfOperatorRecords;
