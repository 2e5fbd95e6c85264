"""External objects of the library: tables, made when a model is translated, looked up by functions at run time.

Our own implementations of what Modelica.Blocks.Types.ExternalCombi* and Modelica.Blocks.Tables.Internal declare as
external C. Values that a table is made of become structural, but those that follow scalar parameters, as in
`[0, Tc; 50, Tc + d]`, and that the table is linear in: these may be set, and fitted, as any parameter.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import is_known, known, variability
from lacuna.codegen.flatten.functions.kept.code import run_or_emit
from lacuna.codegen.flatten.functions.library.data_files import locate
from lacuna.codegen.flatten.functions.library.tables import lookup
from lacuna.codegen.flatten.functions.library.tables import polynomials as pp
from lacuna.codegen.flatten.functions.library.tables.files import FileError, read_matrix
from lacuna.codegen.flatten.functions.library.tables.table import Piece, Table
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, ExternalValue, Value, scalars
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast

Handler = Callable[[list[Value], "ExternalCall"], list[Value]]


@dataclass(frozen=True)
class ExternalCall:
    """An external function that is called: where, and by whom."""

    cls: ast.Class
    scope: Scope  # of the call
    span: Span


def _numbers(value: Value, call: ExternalCall, what: str) -> list[float]:
    result = []
    for item in scalars(value):
        if not isinstance(item, Expr):
            raise Diagnostic("R062", f"{what} is no number", call.span, "give numbers")
        result.append(known(item, call.scope, call.span, what).value)
    return result


def integer(value: Value, call: ExternalCall, what: str) -> int:
    return int(_numbers(value, call, what)[0])


def _real(value: Value, call: ExternalCall, what: str) -> float:
    return float(_numbers(value, call, what)[0])


def _follows(e: Expr, context: Context) -> bool:
    """Whether a value of a table is or depends on scalar parameters; elements of matrices are the table itself."""
    while e.op == "var" and str(e.value) in context.scalars:
        leaf, position = context.scalars[str(e.value)]
        if leaf.variability != "parameter" or leaf.is_free or not leaf.shape:
            break
        bound = leaf.element(leaf.binding(), position)
        if bound is None:
            return False
        e = bound
    return variability(e, context) == "parameter" and is_known(e, context)


def _matrix(
    file: Value, name: Value, table: Value, rest: list[Value], call: ExternalCall, linear: bool = False
) -> list[list[float | Expr]]:
    """The data of a table: of a file where one is named, else as given; where it is `linear` in it, values that follow
    parameters as they are."""
    if not isinstance(file, str) or not isinstance(name, str):
        raise Diagnostic("R062", "the names of file and table are Strings", call.span, "give two Strings")
    if file not in ("", "NoName"):
        return _from_file(file, name, rest, call)
    if name not in ("", "NoName") and not scalars(table):
        hint = "name a file with it, or give the matrix"
        raise Diagnostic("F043", f"the table {name} would come from a function of the C program", call.span, hint)
    if not isinstance(table, Array) or len(table.shape) != 2 or 0 in table.shape:
        raise Diagnostic("F043", "a table without data", call.span, "give a matrix, or a file and a name")
    width, context = table.shape[1], call.scope.context
    free = [
        k for k, e in enumerate(table.items) if linear and k % width and isinstance(e, Expr) and _follows(e, context)
    ]
    fixed = Array(table.shape, tuple(ex.const(0.0) if k in free else e for k, e in enumerate(table.items)))
    numbers: list[float | Expr] = [float(n) for n in _numbers(fixed, call, "the data of a table")]
    for k in free:
        numbers[k] = table.items[k]
    return [numbers[k : k + width] for k in range(0, len(numbers), width)]


def _from_file(file: str, name: str, rest: list[Value], call: ExternalCall) -> list[list[float]]:
    delimiter = next((r for r in rest if isinstance(r, str)), ",")
    header = rest[-1]
    lines = integer(header, call, "the number of header lines") if isinstance(header, Expr) else 0
    path = locate(file, call.scope.context, call.span)
    try:
        content = path.read_bytes()
        rows = read_matrix(path, name, delimiter, lines)
    except (OSError, UnicodeDecodeError, FileError) as reason:
        raise Diagnostic("F041", f"{path.name}: {reason}", call.span, "correct the file, or its name") from None
    call.scope.context.note_file(path, content)
    return rows


def _columns(value: Value, rows: list[list[float]], call: ExternalCall) -> list[int]:
    columns = [int(n) for n in _numbers(value, call, "the columns of a table")] or list(range(2, len(rows[0]) + 1))
    for n in columns:
        if not 1 <= n <= len(rows[0]):
            raise Diagnostic("F043", f"column {n} of a table with {len(rows[0])} columns", call.span, "columns")
    return columns


def _checked(table: Table, call: ExternalCall) -> list[Value]:
    try:
        pp.check_abscissa(table.abscissa, table.smoothness)
    except pp.TableError as reason:
        raise Diagnostic("F043", str(reason), call.span, "the first column of a table ascends") from None
    return [ExternalValue(call.cls.parent, table)]


def _table_1d(a: list[Value], call: ExternalCall) -> list[Value]:
    """(fileName, tableName, table, rows, columns, columns[:], count, smoothness, extrapolation, verbose, ...)"""
    kinds = (integer(a[7], call, "smoothness"), integer(a[8], call, "extrapolation"))
    rows = _matrix(a[0], a[1], a[2], a[9:], call, kinds[0] in (pp.LINEAR, pp.CONSTANT))
    return _checked(Table(rows, _columns(a[5], rows, call), *kinds), call)


def _time_table(a: list[Value], call: ExternalCall) -> list[Value]:
    """(file, name, table, rows, columns, start, columns[:], count, smoothness, extrapolation, shift, events, ...)"""
    smoothness, extrapolation = integer(a[8], call, "smoothness"), integer(a[9], call, "extrapolation")
    rows = _matrix(a[0], a[1], a[2], a[12:], call, smoothness in (pp.LINEAR, pp.CONSTANT))
    start, shift = _real(a[5], call, "the start of a table"), _real(a[10], call, "the shift of a table")
    events = integer(a[11], call, "timeEvents")
    columns = _columns(a[6], rows, call)
    return _checked(Table(rows, columns, smoothness, extrapolation, start, shift, events), call)


def _table_2d(a: list[Value], call: ExternalCall) -> list[Value]:
    """(fileName, tableName, table, rows, columns, smoothness, extrapolation, verbose, ...)"""
    rows = _matrix(a[0], a[1], a[2], a[7:], call)
    smoothness, extrapolation = integer(a[5], call, "smoothness"), integer(a[6], call, "extrapolation")
    if smoothness not in (pp.LINEAR, pp.CONSTANT):
        hint = "LinearSegments or ConstantSegments"
        raise Diagnostic("R091", "smooth interpolation in two dimensions is outside the subset", call.span, hint)
    if len(rows) < 2 or len(rows[0]) < 2:
        raise Diagnostic("F043", "a table in two dimensions needs at least one row and one column", call.span, "u1, u2")
    for axis in ([row[0] for row in rows[1:]], rows[0][1:]):
        try:
            pp.check_abscissa(axis, pp.AKIMA)
        except pp.TableError as reason:
            raise Diagnostic("F043", str(reason), call.span, "grid points ascend") from None
    return [ExternalValue(call.cls.parent, Table(rows, [], smoothness, extrapolation))]


def _table(value: Value, call: ExternalCall) -> Table:
    if not isinstance(value, ExternalValue) or not isinstance(value.data, Table):
        raise Diagnostic("R062", f"{call.cls.name} needs a table", call.span, "give the external object of one")
    return value.data


def vector(values: list[float] | list[float | Expr]) -> Array:
    return Array((len(values),), tuple(v if isinstance(v, Expr) else ex.const(float(v)) for v in values))


def _pieces(rows: list[Piece]) -> dict[str, Value]:
    flat = [value for row in rows for value in row[1:]]
    return {"x": vector([row[0] for row in rows]), "c": Array((len(rows), 4), vector(flat).items)}


def _run(name: str, arguments: dict[str, Value], call: ExternalCall) -> list[Value]:
    """A function of `lookup`: evaluated where all is constant, else called at run time."""
    arguments = {k: ex.const(float(v)) if isinstance(v, float | int) else v for k, v in arguments.items()}
    return run_or_emit(lookup.function(name), arguments, call.scope.context, call.span)


def _value_1d(a: list[Value], call: ExternalCall) -> list[Value]:
    """(tableID, icol, u)"""
    table = _table(a[0], call)
    rows = table.column(integer(a[1], call, "the column"), call.span)
    x = table.abscissa
    if table.period:
        return _run("periodic", {"u": a[2], "first": x[0], "period": table.period, **_pieces(rows)}, call)
    if table.extrapolation == pp.REFUSE:
        return _run("inside", {"u": a[2], "first": x[0], "last": x[-1], **_pieces(rows)}, call)
    return _run("piecewise", {"u": a[2], **_pieces(rows)}, call)


def _value_timed(a: list[Value], call: ExternalCall) -> list[Value]:
    """(tableID, icol, t, next, before)"""
    table = _table(a[0], call)
    rows = table.column(integer(a[1], call, "the column"), call.span)
    x = table.abscissa
    place = {"t": a[2], "next": a[3], "before": a[4], "start": table.start, "shift": table.shift, "first": x[0]}
    if table.extrapolation == pp.REFUSE and len(x) > 1:
        return _run("timedInside", {**place, "last": x[-1], **_pieces(rows)}, call)
    return _run("timed", {**place, "period": table.period, **_pieces(rows)}, call)


def _next_event(a: list[Value], call: ExternalCall) -> list[Value]:
    """(tableID, t)"""
    table = _table(a[0], call)
    place = {"start": table.start, "shift": table.shift, "first": table.abscissa[0], "period": table.period}
    instants = vector(table.instants() or [-lookup.NEVER])
    if not table.instants():
        place["period"] = 0.0
    return _run("nextEvent", {"t": a[1], **place, "instants": instants}, call)


def _value_2d(a: list[Value], call: ExternalCall) -> list[Value]:
    """(tableID, u1, u2)"""
    table = _table(a[0], call)
    x, y = [row[0] for row in table.rows[1:]], table.rows[0][1:]
    if len(x) == 1 or len(y) == 1 or table.extrapolation in (pp.PERIODIC, pp.REFUSE):
        hint = "two or more grid points each way, HoldLastPoint or LastTwoPoints"
        raise Diagnostic("R091", "this table in two dimensions is outside the subset", call.span, hint)
    z = Array((len(x), len(y)), vector([v for row in table.rows[1:] for v in row[1:]]).items)
    hold = ex.const(table.extrapolation == pp.HOLD)
    grid = {"u": a[1], "v": a[2], "hold": hold, "x": vector(x), "y": vector(y), "z": z}
    return _run("steps" if table.smoothness == pp.CONSTANT else "bilinear", grid, call)


def _edge(last: bool, call_2d: bool = False) -> Handler:
    def build(a: list[Value], call: ExternalCall) -> list[Value]:
        table = _table(a[0], call)
        at = -1 if last else 0
        if call_2d:
            return [vector([[row[0] for row in table.rows[1:]][at], table.rows[0][1:][at]])]
        return [ex.const(table.abscissa[at])]

    return build


_P = "ModelicaStandardTables_"
TABLES: dict[str, Handler] = {
    f"{_P}CombiTable1D_init3": _table_1d, f"{_P}CombiTimeTable_init3": _time_table,
    f"{_P}CombiTable2D_init3": _table_2d,
    f"{_P}CombiTable1D_getValue": _value_1d, f"{_P}CombiTimeTable_getValue": _value_timed,
    f"{_P}CombiTable2D_getValue": _value_2d, f"{_P}CombiTimeTable_nextTimeEvent": _next_event,
    f"{_P}CombiTable1D_minimumAbscissa": _edge(False), f"{_P}CombiTable1D_maximumAbscissa": _edge(True),
    f"{_P}CombiTimeTable_minimumTime": _edge(False), f"{_P}CombiTimeTable_maximumTime": _edge(True),
    f"{_P}CombiTable2D_minimumAbscissa": _edge(False, True), f"{_P}CombiTable2D_maximumAbscissa": _edge(True, True),
}  # fmt: skip
