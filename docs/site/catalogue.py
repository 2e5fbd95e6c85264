"""The catalogue of components, effects, laws and machines: one page a package of model/, one section a class, all of it
from the sources: what it is, parameters and variables with units, equations as written, a simulated response."""

from __future__ import annotations

from collections.abc import Iterator
import html
from pathlib import Path
import re

from docs.site.responses import FLANGES, OUTPUTS, PINS, SIGNALS, Drawer, Part
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flat import Variable
from lacuna.codegen.flatten import flatten
from lacuna.codegen.flatten.names.scope import base_classes
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast

MODEL_FOLDER = Path(__file__).resolve().parents[2] / "model"
PACKAGES = (
    "Components.Mechanics", "Components.Electrical", "Components.Drives", "Components.Control", "Components.Sensors",
    "Components.Sources", "Components.Monitors", "Effects", "Degradation", "Actuators", "Benches", "Interfaces",
)  # fmt: skip
DRAWN = ("Components", "Effects")  # machines have their figures on the pages of the guide
ORDER = {"parameter": 0, "constant": 2}  # in a table; variables between them
SLIGHT = 0.3  # of an effect's parameter without a start: seen, and within the amplitude 1 of what moves
CONNECTORS = {*FLANGES, *PINS, *SIGNALS, *OUTPUTS}
INTRODUCTION = """# Catalogue

Every class of package Lacuna, from its source: what it is, parameters and variables with their units, its equations as
they are written, and a simulated response. These pages are made from `model/` whenever the site is built.

"""


def names() -> list[str]:
    return list(PACKAGES)


def pages(drawer: Drawer) -> dict[str, str]:
    """Markdown pages and SVG figures by their path below catalogue/."""
    library = Library([MODEL_FOLDER])
    made = {"index.md": INTRODUCTION}
    for package in PACKAGES:
        folder = library.find(f"Lacuna.{package}")
        classes = [library.member(folder, name) for name in library.members(folder)]
        classes = [c for c in classes if c is not None and c.kind in ("model", "block", "class", "connector")]
        made["index.md"] += f"- [{package}]({package}.md): {folder.description} ({len(classes)})\n"
        sections = [_section(library, cls, drawer, made) for cls in classes]
        made[f"{package}.md"] = f"# {package}\n\n{folder.description}.\n\n" + "\n".join(sections)
    return made


def _section(library: Library, cls: ast.Class, drawer: Drawer, made: dict[str, str]) -> str:
    text = f"## {cls.name}\n\n{'Partial. ' if cls.partial else ''}{cls.description}\n\n"
    bases = [_link(base) for base in base_classes(library, cls)]
    if bases:
        text += f"Extends {', '.join(bases)}.\n\n"
    text += _annotated(cls)
    if cls.path.split(".")[1] in DRAWN and not cls.partial:
        response = drawer.response(part(library, cls))
        if response is not None:
            made[f"{cls.path}.svg"] = response.svg
            text += f"![{cls.name}: {response.caption}]({cls.path}.svg)\n\n*{response.caption}*\n\n"
    return text + _table(library, cls) + _equations(library, cls)


def _link(cls: ast.Class) -> str:
    package, _, name = cls.path.removeprefix("Lacuna.").rpartition(".")
    return f"[{package}.{name}]({package}.md#{name.lower()})" if package in PACKAGES else f"`{package}.{name}`"


def _annotated(cls: ast.Class) -> str:
    """The documentation of the class, and of an effect what it leaves, when it is seen and where it is described."""
    text = ""
    for argument in cls.annotation.arguments if cls.annotation else ():
        for inner in argument.modification.arguments:
            value = getattr(inner.modification.value, "value", None)
            if argument.name == "Documentation" and inner.name == "info":
                body = re.sub(r"</?html>", "", value).strip()
                text += "<div>\n" + "\n".join(line for line in body.splitlines() if line.strip()) + "\n</div>\n\n"
            elif argument.name == "__Lacuna" and inner.name in ("effect", "signature", "excitation", "reference"):
                text += f"- *{inner.name}*: {value}\n"
    return text + "\n"


def _table(library: Library, cls: ast.Class) -> str:
    """Parameters and variables as the flat class has them; nothing where it cannot stand alone."""
    if cls.kind == "connector":
        return ""
    try:
        flat = flatten(library, cls.path, units="warn")
    except Diagnostic:
        return ""
    own = {c.name for c in _components(library, cls) if not c.protected}
    shown = [v for v in flat.variables.values() if re.split(r"[.\[]", v.name)[0] in own and "." not in v.name]
    rows = [_row(v) for v in sorted(shown, key=lambda v: ORDER.get(v.variability, 1))]
    head = "| name | unit | default | |\n| --- | --- | --- | --- |\n"
    return head + "".join(rows) + "\n" if rows else ""


def _row(variable: Variable) -> str:
    default = _number(variable.binding) if variable.variability == "parameter" else ""
    kind = {"parameter": "parameter", "constant": "constant"}.get(variable.variability, "")
    said = ": ".join(word for word in (kind, variable.description) if word)
    unit = variable.unit or variable.inferred_unit
    return f"| `{variable.name}` | {unit} | {default} | {html.escape(said, quote=False)} |\n"


def _number(value: Expr | None) -> str:
    return f"{value.value:g}" if value is not None and value.op == "const" and not isinstance(value.value, str) else ""


def _equations(library: Library, cls: ast.Class) -> str:
    """The class's own equations and algorithms, then those of what it extends, as written."""
    found = [(c, written) for c in _with_bases(library, cls) if (written := _written(c))]
    return "".join(
        f"```modelica\n{'' if c is cls else f'// from {c.path}' + chr(10)}{text}\n```\n\n" for c, text in found
    )


def _written(cls: ast.Class) -> str:
    """From the first `equation` or `algorithm` of the class's file to its annotation or end."""
    text = Path(cls.span.file).read_text(encoding="utf-8")
    found = re.search(
        rf"^((?:initial )?(?:equation|algorithm)\b.*?)(?=^\s*annotation\s*\(|^end {cls.name};)",
        text,
        re.DOTALL | re.MULTILINE,
    )
    return found[1].rstrip() if found else ""


def _with_bases(library: Library, cls: ast.Class) -> Iterator[ast.Class]:
    yield cls
    for base in base_classes(library, cls):
        yield from _with_bases(library, base)


def _components(library: Library, cls: ast.Class) -> list[ast.Component]:
    return [component for c in _with_bases(library, cls) for component in c.components]


def part(library: Library, cls: ast.Class) -> Part:
    """What a response needs to know of the class; no connectors where one of them is an array."""
    components = _components(library, cls)
    ends = [c for c in components if c.type.names[-1] in CONNECTORS]
    if any(c.dimensions for c in ends):
        ends = []
    starts = {a.name: min(numbers, key=abs) for a in _starts(cls) if (numbers := _numbers(a.modification.value))}
    if cls.path.startswith("Lacuna.Effects."):  # by default an effect is none
        own = [c for c in cls.components if c.variability == "parameter" and c.name not in starts]
        starts |= {c.name: SLIGHT for c in own if not _plain(c.modification.value) and c.type.names[-1] != "Time"}
    times = [c for c in components if c.variability == "parameter" and c.type.names[-1] == "Time"]
    slowest = max((starts.get(c.name) or _plain(c.modification.value) or 0.0 for c in times), default=0.0)
    connectors = tuple((c.name, c.type.names[-1]) for c in ends)
    return Part(cls.path, connectors, tuple(sorted(starts.items())), slowest)


def _starts(cls: ast.Class) -> list[ast.Argument]:
    annotation = cls.annotation.arguments if cls.annotation else []
    return [
        value for argument in annotation if argument.name == "__Lacuna"
        for entry in argument.modification.arguments if entry.name in ("starts", "variants")
        for value in entry.modification.arguments
    ]  # fmt: skip


def _numbers(value: ast.Expression | None) -> list[float]:
    elements = value.elements if isinstance(value, ast.ArrayLiteral) else [value]
    return [number for element in elements if (number := _plain(element)) is not None and number != 0]


def _plain(value: ast.Expression | None) -> float | None:
    if isinstance(value, ast.Unary) and value.op == "-":
        inner = _plain(value.operand)
        return None if inner is None else -inner
    return value.value if isinstance(value, ast.Literal) and isinstance(value.value, int | float) else None
