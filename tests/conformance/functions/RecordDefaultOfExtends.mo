// section: 7.2
// value: y = -6
package Shapes
  package K
    constant Real three = 3;
  end K;
  record Base
    parameter Real offset = 0;
  end Base;
  record Shifted
    import Shapes.K.three;
    extends Base(final offset = -2*three);
  end Shifted;
end Shapes;
model RecordDefaultOfExtends
  parameter Shapes.Base shape = Shapes.Shifted();
  Real y = shape.offset;
end RecordDefaultOfExtends;
