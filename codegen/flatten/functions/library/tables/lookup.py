"""Looking up tables at run time: functions of the language, which are emitted and differentiated as any other.

`piecewise` evaluates the rows of `polynomials.piecewise`, `x` being their first column and `c` the others. `timed` does
so over time, with the side of a jump decided by the events of the table: while `next` is pending (the event has come
but is not handled yet) the value from before it holds. `nextEvent` gives the instants. Times are those of the table,
scaled and shifted; comparisons of them allow for the rounding of t/scale and t - shift.
"""

from __future__ import annotations

from functools import lru_cache

from lacuna.codegen.syntax import ast, parse

NEVER = 1e60  # an instant that no simulation reaches

_TEXT = """
package Tables
  function find "The last row whose x is not above u; the first where there is none"
    input Real x[:];
    input Real u;
    output Integer row;
  protected
    Integer above;
    Integer middle;
  algorithm
    row := 1;
    above := size(x, 1) + 1;
    while above - row > 1 loop
      middle := div(row + above, 2);
      if x[middle] <= u then
        row := middle;
      else
        above := middle;
      end if;
    end while;
  end find;

  function piecewise
    input Real u;
    input Real x[:];
    input Real c[size(x, 1), 4];
    output Real y;
  protected
    Integer row;
    Real s;
  algorithm
    row := find(x, u);
    s := u - x[row];
    y := c[row, 1] + s*(c[row, 2] + s*(c[row, 3] + s*c[row, 4]));
  end piecewise;

  function periodic
    input Real u;
    input Real first;
    input Real period;
    input Real x[:];
    input Real c[size(x, 1), 4];
    output Real y;
  algorithm
    y := piecewise(u - period*floor((u - first)/period), x, c);
  end periodic;

  function inside "As piecewise; fails outside of the table"
    input Real u;
    input Real first;
    input Real last;
    input Real x[:];
    input Real c[size(x, 1), 4];
    output Real y;
  algorithm
    assert(u >= first and u <= last, "a table is asked for a value outside of its abscissa, and must not extrapolate");
    y := piecewise(u, x, c);
  end inside;

  partial function OverTime
    input Real t;
    input Real next;
    input Real before;
    input Real start;
    input Real shift;
    input Real first;
    input Real x[:];
    input Real c[size(x, 1), 4];
    output Real y;
  protected
    Real near;
  end OverTime;

  function timed
    extends OverTime;
    input Real period "0: not periodic";
  protected
    Real side "where the row is looked for";
    Real turns;
    Integer row;
    Real s;
  algorithm
    near := 1e-14*(abs(t) + abs(shift));
    side := if next <= before and t >= next - near then next - 2*near else t + near;
    if side < start then
      y := 0;
    else
      turns := if period > 0 then floor((side - shift - first)/period) else 0;
      row := find(x, side - shift - turns*period);
      s := t - shift - turns*period - x[row];
      y := c[row, 1] + s*(c[row, 2] + s*(c[row, 3] + s*c[row, 4]));
    end if;
  end timed;

  function timedInside "As timed; fails outside of the table, from its start on"
    extends OverTime;
    input Real last;
  algorithm
    near := 1e-14*(abs(t) + abs(shift));
    assert(t < start or t - shift >= first - near and t - shift <= last + near,
      "a table is asked for a time outside of its abscissa, and must not extrapolate");
    y := timed(t, next, before, start, shift, first, x, c, 0);
  end timedInside;

  function nextEvent
    input Real t;
    input Real start;
    input Real shift;
    input Real first;
    input Real period "0: not periodic";
    input Real instants[:] "in the time of the table, ascending";
    output Real next;
  protected
    Real near;
    Real turns;
    Real place;
    Integer row;
  algorithm
    near := 1e-14*(abs(t) + abs(shift));
    if t < start - near then
      next := start;
    else
      turns := if period > 0 then floor((t + near - shift - first)/period) else 0;
      place := t + near - shift - turns*period;
      row := 1;
      while row < size(instants, 1) and instants[row] <= place loop
        row := row + 1;
      end while;
      if instants[row] > place then
        next := instants[row] + shift + turns*period;
      elseif period > 0 then
        next := instants[1] + shift + (turns + 1)*period;
      else
        next := 1e60;
      end if;
    end if;
  end nextEvent;

  function bilinear "Between grid points; at the edge the nearest cell is continued, where `hold` is not set"
    input Real u;
    input Real v;
    input Boolean hold;
    input Real x[:];
    input Real y[:];
    input Real z[size(x, 1), size(y, 1)];
    output Real w;
  protected
    Real a;
    Real b;
    Integer i;
    Integer j;
  algorithm
    a := if hold then min(max(u, x[1]), x[size(x, 1)]) else u;
    b := if hold then min(max(v, y[1]), y[size(y, 1)]) else v;
    i := min(find(x, a), size(x, 1) - 1);
    j := min(find(y, b), size(y, 1) - 1);
    a := (a - x[i])/(x[i + 1] - x[i]);
    b := (b - y[j])/(y[j + 1] - y[j]);
    w := (1 - a)*((1 - b)*z[i, j] + b*z[i, j + 1]) + a*((1 - b)*z[i + 1, j] + b*z[i + 1, j + 1]);
  end bilinear;

  function steps "The value of the cell's lower corner; beyond the edge as `bilinear`, where `hold` is not set"
    input Real u;
    input Real v;
    input Boolean hold;
    input Real x[:];
    input Real y[:];
    input Real z[size(x, 1), size(y, 1)];
    output Real w;
  algorithm
    if hold or u >= x[1] and u <= x[size(x, 1)] and v >= y[1] and v <= y[size(y, 1)] then
      w := z[find(x, u), find(y, v)];
    else
      w := bilinear(u, v, false, x, y, z);
    end if;
  end steps;
end Tables;
"""


@lru_cache(maxsize=1)
def _package() -> ast.Class:
    return parse(_TEXT, "tables.mo")[0]


def function(name: str) -> ast.Class:
    return _package().classes[name]
