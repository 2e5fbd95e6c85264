// section: 5.4
// value: p.u.c.y = 4, q.u.c.y = 2
model InnerClassRedeclared "What stands for an inner class is inner"
  model D
    Real y = 2*time;
  end D;
  model E
    Real y = 4*time;
  end E;
  model User
    outer model M = D;
    M c;
  end User;
  model Around
    inner replaceable model M = D;
    User u;
  end Around;
  Around p(redeclare model M = E);
  Around q;
end InnerClassRedeclared;
