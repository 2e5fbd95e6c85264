"""Modelica.Utilities.Streams read at translation, in place of their external C: lines of texts, matrices of files."""

from __future__ import annotations

from pathlib import Path

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.functions.library.data_files import locate, text_of
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler, integer, vector
from lacuna.codegen.flatten.functions.library.tables.files import FileError, read_matrix
from lacuna.codegen.flatten.names.values import Array, Value
from lacuna.codegen.symbolic import expr as ex


def _file(name: Value, call: ExternalCall) -> Path:
    """Where a named file lies; the model depends on it from now on."""
    if not isinstance(name, str):
        raise Diagnostic("R062", f"{call.cls.name} takes the name of a file", call.span, "give a String")
    return locate(name, call.scope.context, call.span)


def _lines(name: Value, call: ExternalCall) -> list[str]:
    path = _file(name, call)
    return text_of(path, call.scope.context, call.span).splitlines()


def _read_line(a: list[Value], call: ExternalCall) -> list[Value]:
    """(fileName, lineNumber): the line, and whether the file ends before it."""
    lines, number = _lines(a[0], call), integer(a[1], call, "the number of a line")
    return [lines[number - 1], ex.FALSE] if 1 <= number <= len(lines) else ["", ex.TRUE]


def _count_lines(a: list[Value], call: ExternalCall) -> list[Value]:
    return [ex.const(len(_lines(a[0], call)))]


def _read_file(a: list[Value], call: ExternalCall) -> list[Value]:
    lines = _lines(a[0], call)
    return [Array((len(lines),), tuple(lines))]


def _matrix_of(a: list[Value], call: ExternalCall) -> list[list[float]]:
    """The matrix of (fileName, matrixName, ...)."""
    path, name = _file(a[0], call), a[1]
    if not isinstance(name, str):
        raise Diagnostic("R062", f"{call.cls.name} takes the name of a matrix", call.span, "give a String")
    try:
        content = path.read_bytes()
        rows = read_matrix(path, name)
    except (OSError, UnicodeDecodeError, FileError) as reason:
        raise Diagnostic("F041", f"{path.name}: {reason}", call.span, "correct the file, or its name") from None
    call.scope.context.note_file(path, content)
    return rows


def _matrix_sizes(a: list[Value], call: ExternalCall) -> list[Value]:
    rows = _matrix_of(a, call)
    return [Array((2,), (ex.const(len(rows)), ex.const(len(rows[0]) if rows else 0)))]


def _real_matrix(a: list[Value], call: ExternalCall) -> list[Value]:
    rows = _matrix_of(a, call)
    return [Array((len(rows), len(rows[0]) if rows else 0), vector([v for row in rows for v in row]).items)]


def _nothing(a: list[Value], call: ExternalCall) -> list[Value]:
    return []


STREAMS: dict[str, Handler] = {
    "ModelicaInternal_readLine": _read_line, "ModelicaInternal_countLines": _count_lines,
    "ModelicaInternal_readFile": _read_file, "ModelicaStreams_closeFile": _nothing,
    "ModelicaIO_readMatrixSizes": _matrix_sizes, "ModelicaIO_readRealMatrix": _real_matrix,
}  # fmt: skip
