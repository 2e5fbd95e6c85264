// section: 4.4.5
// value: h.y = 4, h.n = 2
model ConditionalInputBelow "multi-level conditional connectors"
  connector RealIn = input Real;
  connector RealOut = output Real;
  block G
    parameter Boolean use = false;
    RealIn u if use;
    RealOut y;
  protected
    RealIn inner_u;
  equation
    connect(u, inner_u);
    if not use then
      inner_u = 1;
    end if;
    y = 2*inner_u;
  end G;
  block H
    parameter Boolean deep = false;
    RealIn u if deep;
    G g(use = deep);
    Real y = g.y;
    parameter Integer n = if deep then 2 else 1;
  equation
    connect(u, g.u);
  end H;
  block Two
    RealOut y = 2*time;
  end Two;
  H h(deep = true), k;
  Two t;
equation
  connect(t.y, h.u);
end ConditionalInputBelow;
