// section: 7.2.5
// value: c.a[1].q.y = 8
// value: c.a[3].q.y = 24
// value: c.a[2].q.x = 5
// value: d.a[2].q.y = 2
// value: d.a[2].q.z = 7
model EachBesideElements "what an inner modification gives each element stays so beside values of each from outside"
  model P
    parameter Real x = 0;
    Real y = x*time;
  end P;
  model Q
    extends P;
    Real z = 7*time;
  end Q;
  model A
    replaceable P q;
  end A;
  model B
    A a[3](each q(x=5));
  end B;
  model C
    extends B(a(q(y={8, 16, 24}*time)));
  end C;
  model D
    A a[3](redeclare each Q q);
  end D;
  model E
    extends D(a(q(x={1, 2, 3})));
  end E;
  C c;
  E d;
end EachBesideElements;
