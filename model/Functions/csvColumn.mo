within Lacuna.Functions;
function csvColumn "Column of a CSV file, read when the model is translated"
  input String fileName "File, beside the model or in the folder of its package";
  input String column "Heading of the column";
  output Real values[:] "Numbers under the heading";
  external "builtin";
  annotation(Documentation(info="<html>
<p>The file has one line of headings and lines of numbers; lines that begin with <code>#</code> are comments. Its
content is
part of the translated model: when the file changes, the model is translated again.</p>
</html>"));
end csvColumn;
