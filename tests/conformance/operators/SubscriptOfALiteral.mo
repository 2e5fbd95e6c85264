// section: 10.5
// refuse: R044 5
model SubscriptOfALiteral
  type E = enumeration(one, two);
  E e = E.one[1];
end SubscriptOfALiteral;
