// section: 5.4
// value: e.f.g.h.a.y = 40, e.f.g.h.a.b.c.d.z = 40, a.b.c.d.z = 60
model A
  outer Real TI;
  model B
    Real TI = 10;
    model C
      Real TI = 20;
      model D
        outer Real TI;
        Real z = TI;
      end D;
      D d;
    end C;
    C c;
  end B;
  B b;
  Real y = TI;
end A;
model E
  inner Real TI = 30;
  model F
    inner Real TI = 40;
    model G
      Real TI = 50;
      model H
        A a;
      end H;
      H h;
    end G;
    G g;
  end F;
  F f;
end E;
model InnerOfThreeLevels
  inner Real TI = 60;
  E e;
  A a;
end InnerOfThreeLevels;
