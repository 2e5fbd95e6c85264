// section: 10.1
// value: n = 3
model SizeFromRecord
  record Data
    parameter Real table[:] = {1, 2};
  end Data;
  model Part
    parameter Data data;
    Real n = size(data.table, 1);
  end Part;
  parameter Data long(table={1, 2, 3});
  Part p(data=long);
  Real n = p.n;
end SizeFromRecord;
