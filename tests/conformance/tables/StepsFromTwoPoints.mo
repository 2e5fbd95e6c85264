// section: 12.9.7
// value: y at 0.1 = 4, y at 0.3 = 7, y at 0.6 = 5, y at 0.9 = 6, z at 0.1 = 4, z at 0.3 = 7, z at 0.6 = 6
model StepsFromTwoPoints "A jump at the first point: before it the first value is held, from it on the second"
  class Table
    extends ExternalObject;
    function constructor
      input Real table[:, :];
      input Integer smoothness;
      output Table t;
    external "C" t = ModelicaStandardTables_CombiTable1D_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), {2}, 1, smoothness, 1, false, ",", 0);
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
  parameter Table steps = Table([2, 4; 2, 7; 4, 5; 8, 6], 3);
  parameter Table lines = Table([2, 4; 2, 7; 4, 7; 8, 5], 1);
  Real y = value(steps, 10*time);
  Real z = value(lines, 10*time);
end StepsFromTwoPoints;
