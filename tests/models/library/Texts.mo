model Texts
  import Modelica.Utilities.Strings.*;
  parameter Real number = scanReal("  12.5e1 a");
  parameter Integer whole = scanInteger("12,4", 4);
  parameter Integer place = find("hallo welt", "welt");
  parameter Integer length = Modelica.Utilities.Strings.length(scanString("  \"a\\\"c\" d")) "of a\"c, with the backslash";
  parameter Real product = Modelica.Utilities.Examples.calculator("2*(3+4)");
  Real x = number*time;
end Texts;
