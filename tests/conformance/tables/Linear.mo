// section: 12.9.7
// value: y at 0.25 = 1, y = 3.5, l at 0.25 = 1
model Linear "Straight lines; beyond the last point the last line"
  class Table
    extends ExternalObject;
    function constructor
      input Real table[:, :];
      input Integer smoothness;
      input Integer extrapolation;
      output Table t;
    external "C" t = ModelicaStandardTables_CombiTable1D_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), {2}, 1, smoothness, extrapolation, false, ",", 0);
    end constructor;
    function destructor
      input Table t;
    external "C" ModelicaStandardTables_CombiTable1D_close(t);
    end destructor;
  end Table;
  function value
    input Table t;
    input Real u;
    output Real y;
  external "C" y = ModelicaStandardTables_CombiTable1D_getValue(t, 1, u);
  end value;
  parameter Table line = Table([0, 0; 1, 2; 2, 3], 1, 2);
  parameter Table steps = Table([0, 1; 1, 2; 2, 3], 3, 1);
  Real y = value(line, 2*time + 0.5 - 0.5*min(1, max(0, 2 - 4*time)));
  Real l = value(steps, 2*time);
end Linear;
