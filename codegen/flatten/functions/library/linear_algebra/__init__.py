"""What Modelica.Math.Matrices asks of LAPACK, as functions of the language."""
