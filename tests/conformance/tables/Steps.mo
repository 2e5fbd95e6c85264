// section: 12.9.7
// value: y at 0 = -1, y at 0.4 = 1, y at 0.7 = 3, y at 1 = 1, w at 0 = -1, w at 0.6 = 1, w at 1 = 3
model Steps "Steps between the points; where they are extrapolated, the line through the first or last two of them"
  class Table
    extends ExternalObject;
    function constructor
      input Real table[:, :];
      output Table t;
    external "C" t = ModelicaStandardTables_CombiTable1D_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), {2}, 1, 3, 2, false, ",", 0);
    end constructor;
    function destructor
      input Table t;
    external "C" ModelicaStandardTables_CombiTable1D_close(t);
    end destructor;
  end Table;
  class Grid
    extends ExternalObject;
    function constructor
      input Real table[:, :];
      output Grid t;
    external "C" t = ModelicaStandardTables_CombiTable2D_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), 3, 2, false, ",", 0);
    end constructor;
    function destructor
      input Grid t;
    external "C" ModelicaStandardTables_CombiTable2D_close(t);
    end destructor;
  end Grid;
  function value
    input Table t;
    input Real u;
    output Real y;
  external "C" y = ModelicaStandardTables_CombiTable1D_getValue(t, 1, u);
  end value;
  function valueOfTwo
    input Grid t;
    input Real u;
    input Real v;
    output Real y;
  external "C" y = ModelicaStandardTables_CombiTable2D_getValue(t, u, v);
  end valueOfTwo;
  parameter Table line = Table([0, 1; 1, 3; 2, 2]);
  parameter Grid grid = Grid([0, 0, 1; 0, 1, 2; 1, 3, 5]);
  Real y = value(line, 4*time - 1);
  Real w = valueOfTwo(grid, 2*time - 1, 0.5*time);
end Steps;
