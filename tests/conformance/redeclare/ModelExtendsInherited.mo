// section: 7.3.1
// value: m.x = 4
model ModelExtendsInherited
  partial model I
    Real x;
  end I;
  model M0
    replaceable model A = I;
    A a;
    Real x = a.x;
  end M0;
  model M
    extends M0;
    redeclare model extends A
    equation
      x = 4;
    end A;
  end M;
  M m;
end ModelExtendsInherited;
