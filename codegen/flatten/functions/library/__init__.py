"""External functions and objects of the Modelica Standard Library, by implementations of our own."""
