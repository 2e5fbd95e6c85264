// code: F043
// line: 20
// hint: ascends
model M
  class Table
    extends ExternalObject;
    function constructor
      input Real table[:, :];
      output Table t;
    external "C" t = ModelicaStandardTables_CombiTable1D_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), {2}, 1, 1, 2, false, ",", 0);
    end constructor;
  end Table;
  function value
    input Table t;
    input Real u;
    output Real y;
  external "C" y = ModelicaStandardTables_CombiTable1D_getValue(t, 1, u);
  end value;
  parameter Table table = Table([0, 0; 2, 1; 1, 3]);
  Real y = value(table, time);
end M;
