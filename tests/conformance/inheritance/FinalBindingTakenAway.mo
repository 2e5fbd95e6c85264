// section: 7.2.7
// value: diameter = 2, radius = 1
model A
  parameter Real diameter = 1;
  final parameter Real radius = diameter/2;
end A;
model FinalBindingTakenAway
  extends A(final diameter(fixed = false) = break);
  parameter Real square = 4;
initial equation
  square = diameter*2;
end FinalBindingTakenAway;
