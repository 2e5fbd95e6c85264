within Lacuna.Components.Sources;
block CsvTable "Signal from a column of a CSV file, linear between its samples"
  extends Interfaces.Source;
  parameter String fileName "File with a column named time, in seconds, increasing";
  parameter String column = "y" "Heading of the column";
  final parameter Real t[:] = Functions.csvColumn(fileName, "time") "Times";
  final parameter Real values[:] = Functions.csvColumn(fileName, column) "Samples";
protected
  final parameter Integer n = size(t, 1) "Number of samples";
  Integer k(start=0, fixed=true) "Samples that have passed";
  Types.Time t_next(start=0, fixed=true) "Time of the next sample";
  Types.Time t0(start=0, fixed=true) "Begin of the present line";
  Real y0(start=0, fixed=true) "Value there";
  Real slope(start=0, fixed=true) "Slope of the present line, 1/s";
equation
  when {initial(), time >= pre(t_next) and pre(k) < n} then
    k = if initial() then Functions.interval(t, time) else pre(k) + 1;
    t_next = Functions.knot(t, k + 1);
    t0 = Functions.knot(t, k);
    y0 = Functions.knot(values, k);
    slope = if k < 1 or k >= n then 0 else (Functions.knot(values, k + 1) - y0)/(t_next - t0);
  end when;
  y = y0 + slope*(time - t0);
  annotation(Documentation(info="<html>
<p>Each sample is a time event, so the corners of the line are met exactly; before the first and after the last sample
the
signal is constant.</p>
</html>"));
end CsvTable;
