"""External C of the user (Modelica 3.6, 12.9): the call, and the code that its annotation names.

Only where who translates allows it (`Access.external`). Headers of the model are written into the generated C, so that
it depends on nothing else: not what is compiled from the cache, nor an FMU's sources.
"""

from __future__ import annotations

from pathlib import Path
import re

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flat.foreign import Foreign, ForeignCode
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.kept.writer import Writer
from lacuna.codegen.flatten.functions.library.data_files import folder_of, text_of
from lacuna.codegen.flatten.functions.locals import Signature
from lacuna.codegen.flatten.names.annotations import warn_of_slips
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, items_of, shape_of
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">\n]+)[">].*$', re.MULTILINE)
_UTILITIES = "ModelicaUtilities.h"  # ours stands before all texts
_SYSTEM = re.compile(r"\w[\w+-]*")  # the name of a library of the system
_PLATFORM = "linux64"  # folder of binaries (Modelica 3.6, 12.9.4)


def check_foreign(signature: Signature, scope: Scope, span: Span) -> None:
    """Refuses what the interface to C does not carry here: R094."""
    external = signature.external.external
    if not scope.context.library.access.external:
        hint = "--allow-external compiles the C that it names; data comes in by csvColumn(fileName, column)"
        raise Diagnostic("R094", f"the external function {signature.cls.name} is outside the subset", span, hint)
    if external.language != "C":
        hint = "give it an interface in C"
        raise Diagnostic("R094", f"external {external.language} is outside the subset", external.span, hint)
    for local in signature.locals:
        text = local.type.primitive == "String" and local.declaration.causality == "input"
        if local.type.primitive not in ("Real", "Integer", "Boolean") and not text:
            hint = "scalars and arrays of numbers and Booleans, and Strings as inputs"
            message = f"{local.name} of the external function {signature.cls.name} is outside the subset"
            raise Diagnostic("R094", message, local.declaration.span, hint)


def foreign_call(signature: Signature, arguments: dict[str, Value], writer: Writer, span: Span) -> list[flat.Statement]:
    """The statements of the function that `writer` writes, `arguments` being those it is called with; its code is noted
    in the context."""
    cls, context = signature.external, writer.scope.context
    external, outputs = cls.external, [local.name for local in signature.outputs]
    result, written = external.result, external.args
    if not external.function:
        result, written = _by_default(signature, writer.scope, external.span)
    name, declared = external.function or cls.name, _note_code(cls, writer.scope)
    if context.table(ForeignCode).spans.setdefault(name, external.span) is external.span:
        message = f"the external C function {name} is compiled into the model, as allowed"
        context.warnings.append(Diagnostic("W009", message, external.span, severity="warning"))
    statements: list[flat.Statement] = []
    given = tuple(_argument(a, arguments, writer, statements) for a in written)
    own = frozenset(n for kind, n in given if kind == "variable" and n not in arguments) - {str(result)}
    places = own & {local.name for local in signature.locals}
    if result is not None and str(result) not in outputs:
        raise Diagnostic("R062", f"{result} is no output of {cls.name}", external.span, "name an output")
    call = Foreign(name, given, places, None if result is None else str(result), declared, external.span)
    return [*statements, call]


def _by_default(signature: Signature, scope: Scope, span: Span) -> tuple[ast.Ref | None, list[ast.Expression]]:
    """Where no call is written: a single scalar output is the result; arrays are followed by their sizes (12.9.1)."""
    declared = [local for local in signature.locals if local.declaration.causality]
    names = {local.name: ast.Ref(span, (local.name,), (None,)) for local in declared}
    outputs = signature.outputs
    single = outputs[0] if len(outputs) == 1 and not outputs[0].declaration.dimensions else None
    arguments: list[ast.Expression] = []
    for local in declared:
        if local is single:
            continue
        arguments.append(names[local.name])
        for k in range(len(shape_of(scope.locals[local.name])) if local.name in scope.locals else 0):
            size = ast.Ref(span, ("size",), (None,))
            arguments.append(ast.Call(span, size, [names[local.name], ast.Literal(span, k + 1)]))
    return None if single is None else names[single.name], arguments


def _argument(
    e: ast.Expression, arguments: dict[str, Value], writer: Writer, statements: list[flat.Statement]
) -> tuple[str, str | int]:
    name = str(e) if isinstance(e, ast.Ref) else ""
    if isinstance(arguments.get(name), str):
        return "text", str(arguments[name])
    if name in writer.function.types:
        return "variable", name
    value = lower(e, writer.scope)
    if isinstance(value, str):
        return "text", value
    if isinstance(value, Expr) and value.op == "const" and value.type == "Integer":
        return "number", int(value.value)
    if not isinstance(value, Expr):
        raise Diagnostic("R094", "an argument of external C that is computed, and no scalar", e.span, "give a variable")
    computed = f"argument {len(writer.function.types)}"
    writer.function.shapes[computed], writer.function.types[computed] = (), value.type
    statements.append(flat.Assign(computed, value, e.span))
    return "variable", computed


# -- the code -----------------------------------------------------------------------------------------------------


def _note_code(cls: ast.Class, scope: Scope) -> bool:
    """Keep the texts and libraries that the annotation names; whether there is a text."""
    code, span = scope.context.table(ForeignCode), cls.external.span
    inner = Scope(scope.context, cls, None, in_function=True)
    warn_of_slips(cls.external.annotation, _KEYS, scope.context)
    said = {a.name: a.modification.value for a in (cls.external.annotation or ast.Modification(span)).arguments}
    given = {name: _texts(lower(e, inner)) for name, e in said.items() if e is not None and name in _KEYS}
    headers = _folder(given.get("IncludeDirectory"), "Resources/Include", cls, scope)
    for text in given.get("Include", []):
        expanded = _expanded(text, [f for f in [headers] if f], scope, span, set())
        if expanded not in code.texts:
            code.texts.append(expanded)
    binaries = _folder(given.get("LibraryDirectory"), "Resources/Library", cls, scope)
    for name in given.get("Library", []):
        for option in _library(name, binaries, scope, span):
            if option not in code.libraries:
                code.libraries.append(option)
    return bool(given.get("Include"))


_KEYS = ("Include", "IncludeDirectory", "Library", "LibraryDirectory")


def _texts(value: Value) -> list[str]:
    return [s for s in (items_of(value) if isinstance(value, Array) else (value,)) if isinstance(s, str)]


def _folder(given: list[str] | None, default: str, cls: ast.Class, scope: Scope) -> Path | None:
    """The folder that an annotation names, else the usual one of the outermost package, or beside its file."""
    if given:
        return folder_of(given[0], scope.context, cls.external.span)
    top = cls
    while top.parent is not None and top.parent is not scope.context.library.root:
        top = top.parent
    place = scope.context.library.folder_of(top) or Path(top.span.file).resolve().parent
    return place / default if (place / default).is_dir() else None


def _expanded(text: str, folders: list[Path], scope: Scope, span: Span, seen: set[Path]) -> str:
    """`text` with the headers that lie in `folders` in their places, each once; those of the system stay."""

    def replacement(match: re.Match[str]) -> str:
        name = match[1].strip()
        if name == _UTILITIES:
            return ""
        found = next((p for f in folders if (p := (f / name).resolve()).is_file() and p.is_relative_to(f)), None)
        if found is None:
            return match[0]
        if found in seen:
            return ""
        seen.add(found)
        inner = text_of(found, scope.context, span)
        return _expanded(inner, [found.parent, *folders], scope, span, seen)

    return _INCLUDE.sub(replacement, text).strip()


def _library(name: str, folder: Path | None, scope: Scope, span: Span) -> list[str]:
    """Options for the linker: a file of the model's folder, else a library of the system."""
    files = (f"lib{name}.a", f"lib{name}.so", f"{name}.o", name)
    for place in (folder / _PLATFORM, folder) if folder else ():
        for file in files:
            path = (place / file).resolve()
            if path.is_file() and path.is_relative_to(folder.resolve()):
                scope.context.note_file(path, path.read_bytes())
                return [str(path), *([f"-Wl,-rpath,{path.parent}"] if path.suffix == ".so" else [])]
    if not _SYSTEM.fullmatch(name):
        raise Diagnostic("F040", f"there is no library {name}", span, f"looked in {folder}")
    return [f"-l{name}"]
