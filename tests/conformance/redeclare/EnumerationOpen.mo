// section: 7.3
// value: m.n = 3, m.x[3] = 3, m.k = 2
model EnumerationOpen
  model M
    replaceable type E = enumeration(:);
    parameter Integer n = size({e for e in E}, 1);
    Real x[E] = {Integer(e) for e in E};
    Integer k = Integer(f);
    parameter E f;
  end M;
  type F = enumeration(a, b, c);
  M m(redeclare type E = F, f = F.b);
end EnumerationOpen;
