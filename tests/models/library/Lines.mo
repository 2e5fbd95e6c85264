model Lines
  import Modelica.Utilities.Streams.*;
  parameter String file = Modelica.Utilities.Files.loadResource("modelica://Modelica/Resources/Data/Electrical/Digital/Memory_Matrix.txt");
  parameter Integer count = countLines(file);
  parameter Integer second = Modelica.Utilities.Strings.length(readLine(file, 2));
  parameter String all[:] = readFile(file);
  parameter Integer third = Modelica.Utilities.Strings.length(all[3]);
  Real x = count*time;
end Lines;
