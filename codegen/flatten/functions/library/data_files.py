"""Files of data: where they may lie, and columns of comma-separated values, read at translation."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import Array, Value
from lacuna.codegen.symbolic import expr as ex
from lacuna.rows import rows_of
from lacuna.suggest import did_you_mean
from lacuna.texts import decimal

CSV_COLUMN = "csvColumn"
_URI = "modelica://"


def column_of_file(values: list[Value], context: Context, span: Span) -> list[Value]:
    """csvColumn(fileName, column) as a vector of constants."""
    if len(values) != 2 or not all(isinstance(v, str) for v in values):
        raise Diagnostic("R062", f"{CSV_COLUMN} takes the names of a file and of a column", span, "two Strings")
    name, column = values
    path = locate(name, context, span)
    return [csv_column(text_of(path, context, span), path, column, span)]


def locate(name: str, context: Context, span: Span) -> Path:
    """Beside the model's file, beside the file of the call, in the folder of a package, in a folder of data that who
    translates has named, or modelica://Package/...; never outside of these folders. Raises F040."""
    data = map(Path, context.library.access.data)
    folders, wanted = [context.folder, Path(span.file).resolve().parent, *context.library.folders, *data], name
    if name.startswith(_URI):
        folder, wanted = _package_folder(name, context, span)
        folders = [folder]
    for folder in folders:
        path = (folder / wanted).resolve()
        if path.is_file() and any(path.is_relative_to(f.resolve()) for f in folders):
            return path
    searched = ", ".join(dict.fromkeys(map(str, folders)))
    hint = f"looked in and below {searched}; --data names further folders"
    raise Diagnostic("F040", f"there is no data file {name}", span, hint)


def folder_of(uri: str, context: Context, span: Span) -> Path:
    """The folder that modelica://Package/folder means. Raises F040."""
    top, inner = _package_folder(uri, context, span)
    folder = (top / inner).resolve()
    if not folder.is_dir() or not folder.is_relative_to(top.resolve()):
        raise Diagnostic("F040", f"there is no folder {uri}", span, f"looked in {top}")
    return folder


def _package_folder(uri: str, context: Context, span: Span) -> tuple[Path, str]:
    """The folder of the package of modelica://Package/rest, or of the file that it is in, and the rest. Raises F040."""
    package, _, rest = uri.removeprefix(_URI).partition("/")
    cls = context.library.root
    for part in package.split("."):
        cls = context.library.member(cls, part) if cls is not None else None
    if cls is None:
        raise Diagnostic("F040", f"{uri}: there is no package {package}", span, "name a package that is loaded")
    return context.library.folder_of(cls) or Path(cls.span.file).resolve().parent, rest


def text_of(path: Path, context: Context, span: Span) -> str:
    """The text of a file, on which the model depends from now on. Raises F040."""
    try:
        content = path.read_bytes()
        text = content.decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise Diagnostic("F040", f"cannot read {path}: {error}", span, "save it as UTF-8 text") from None
    context.note_file(path, content)
    return text


@lru_cache(maxsize=64)
def _rows(text: str) -> list[list[str]]:
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return [row for _, row in rows_of("\n".join(lines))]


def csv_column(text: str, path: Path, column: str, span: Span) -> Array:
    """The numbers under the heading `column`; lines starting with # are comments. Those under `time` increase."""
    try:
        rows = _rows(text)
    except ValueError as error:
        raise Diagnostic("F041", f"{path.name} is no table: {error}", span, "end the quotation") from None
    if not rows:
        raise Diagnostic("F041", f"{path.name} is empty", span, "the first line names the columns")
    heading = rows[0]
    if column not in heading:
        hint = did_you_mean(column, heading, f"it has {', '.join(heading)}")
        raise Diagnostic("F041", f"{path.name} has no column {column}", span, hint)
    if heading.count(column) > 1:
        raise Diagnostic("F041", f"{path.name} has several columns {column}", span, "give each a name of its own")
    at = heading.index(column)
    numbers: list[float] = []
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(heading):
            message = f"{path.name}, data line {number}: {len(row)} fields where the heading has {len(heading)}"
            raise Diagnostic("F041", message, span, "correct the file: numbers have a decimal point, no comma")
        found = row[at]
        wrong = _objection(found, numbers[-1:] if column == "time" else [])
        if wrong:
            message = f"{path.name}, data line {number}, column {column}: {found!r} {wrong}"
            raise Diagnostic("F041", message, span, "correct the file")
        numbers.append(decimal(found))
    if not numbers:
        raise Diagnostic("F041", f"{path.name} has a heading and no data", span, "add lines of numbers")
    return Array((len(numbers),), tuple(map(ex.const, numbers)))


def _objection(found: str, before: list[float]) -> str | None:
    """What is wrong with a field that should be a number, and greater than the one `before` it, if any."""
    try:
        value = decimal(found)
    except ValueError:
        return "is no finite number"
    return f"does not come after {before[0]:g}" if before and value <= before[0] else None
