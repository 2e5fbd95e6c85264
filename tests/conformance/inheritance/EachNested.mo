// section: 7.2.5
// value: b.c[2].a[3] = 5, b2.c[5].d = 6, e[2].c[4].d = 4, e[2].p = 2, e2[1].c[3].d = 3, e2[2].c[1].a[2] = 2
model C
  parameter Real a[3];
  parameter Real d;
end C;
model B
  C c[5](each a = {1, 2, 3}, d = {1, 2, 3, 4, 5});
  parameter Real p = 0;
end B;
model EachNested
  B b(each c.a = {3, 4, 5}, c.d = {2, 3, 4, 5, 6});
  B b2(c(each a = {3, 4, 5}, d = {2, 3, 4, 5, 6}));
  B e[2](each c(each a = {1, 2, 3}, d = {1, 2, 3, 4, 5}), p = {1, 2});
  B e2[2](c(each a = {1, 2, 3}, d = fill({1, 2, 3, 4, 5}, 2)), p = {1, 2});
end EachNested;
