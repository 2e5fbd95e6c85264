"""What an editor asks of a file, without the protocol: findings, hover, definition, references, completion, outline."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
import re

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flat import FlatModel
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import MODEL_KINDS, Library
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.lexer import KEYWORDS
from lacuna.lsp.buffers import BufferedLibrary
from lacuna.lsp.document import Document, Name, parsed
from lacuna.lsp.resolve import Declared, elements, follow, resolve, type_of
from lacuna.units import symbols

Place = tuple[Path, Span]
_MEANT = re.compile(r"did you mean (.+)\?")


@dataclass
class View:
    """One state of all texts: made anew at every change, with what it found out kept."""

    library: BufferedLibrary
    document: Document | None  # None where the text has no tokens
    findings: list[Diagnostic]
    flat: FlatModel | None = None


class Workspace:
    """Open texts by their resolved paths, over the files of the search path."""

    def __init__(self, search_path: Iterable[str]):
        self.search_path = list(search_path)
        self.texts: dict[Path, str] = {}
        self._views: dict[Path, View] = {}
        self._library: BufferedLibrary | None = None
        self._edited: set[Path] = set()  # since the library read them
        self._last: tuple[Path, View] | None = None  # of that library

    def change(self, path: Path, text: str | None) -> None:
        """A new text, or None for the file on disk again."""
        if text is None:
            self.texts.pop(path, None)
        else:
            self.texts[path] = text
        self._views.clear()
        self._edited.add(path)

    def view(self, path: Path) -> View:
        if path not in self._views:
            self._views[path] = self._look(path)
        return self._views[path]

    def text(self, path: Path) -> str:
        return self.texts[path] if path in self.texts else path.read_text(encoding="utf-8")

    def _look(self, path: Path) -> View:
        view = self._said_again(path)
        if view is None:
            view = self._checked(path, self._renewed())
        self._last = (path, view)
        return view

    def _said_again(self, path: Path) -> View | None:
        """The last view with the text as it is now, where that has the same tokens in the same places."""
        at, last = self._last or (None, None)
        if last is None or at != path or last.document is None or self._edited != {path} or not last.library.current:
            return None
        document = parsed(path, self.text(path), last.document.classes)
        return replace(last, document=document) if document and document.reads_as(last.document) else None

    def _renewed(self) -> BufferedLibrary:
        """The library with all edits: what they do not touch is kept."""
        kept = self._library
        if kept is None or not kept.current or not all(kept.forget(path) for path in self._edited):
            kept = BufferedLibrary(self.search_path, self.texts)
        self._library, self._edited, self._last = kept, set(), None
        return kept

    def _checked(self, path: Path, library: BufferedLibrary) -> View:
        try:
            classes = library.parse_file(path)
        except Diagnostic as finding:
            return View(library, None, [finding])
        own = _within_package(library, path, classes)
        document = parsed(path, self.text(path), own)
        findings, flat = _check(library, path, own)
        return View(library, document, findings, flat)

    def files(self, path: Path) -> list[Path]:
        """The files in which what is declared in `path` may be named: those of its package, those open."""
        top = path.parent
        while (top.parent / "package.mo").is_file():
            top = top.parent
        near = top.rglob("*.mo") if (top / "package.mo").is_file() else path.parent.glob("*.mo")
        return sorted({*(p.resolve() for p in near), *self.texts, path})


def _within_package(library: Library, path: Path, classes: list[ast.Class]) -> list[ast.Class]:
    """The classes of a file as the package around it has them, so that names are looked up outwards."""
    try:
        found = library.find(str(path))
    except Diagnostic:
        return classes
    return [found if c.name == found.name else c for c in classes]


def _check(library: Library, path: Path, classes: list[ast.Class]) -> tuple[list[Diagnostic], FlatModel | None]:
    """Findings of each complete model of the file, and the flat form of the last one."""
    findings, flat = [], None
    for cls in classes:
        inner = [c for c in (cls, *cls.classes.values()) if c.kind in MODEL_KINDS and not c.partial and not c.alias]
        for model in inner:
            try:
                flat = flatten(library, str(path) if model is cls else f"{path}:{model.path}")
                findings += flat.warnings
            except Diagnostic as finding:
                findings += [finding, *finding.others]
    unique = {(f.code, f.span, f.message): f for f in findings}
    return list(unique.values()), flat


def in_file(findings: Iterable[Diagnostic], path: Path) -> Iterator[tuple[Diagnostic, Span]]:
    """Findings with a place in this file; what lies elsewhere is shown at its first line."""
    for finding in findings:
        here = finding.span is not None and Path(finding.span.file).resolve() == path
        yield finding, finding.span if here and finding.span else Span(str(path), 1, 1, 1)


def fixes(finding: Diagnostic) -> list[str]:
    """Names that may be put in place of the one that was not found."""
    meant = _MEANT.search(finding.hint)
    return meant[1].split(" or ") if meant else []


def declaration(view: View, line: int, character: int) -> Declared | None:
    if view.document is None:
        return None
    name = view.document.name_at(view.document.offset(line, character))
    return resolve(view.library, view.document, name) if name else None


def hover(view: View, line: int, character: int) -> str:
    """Markdown: what it is, unit, description, value, and the equations of the flat model that compute it."""
    found = declaration(view, line, character)
    if found is None:
        return ""
    thing = found.element
    if isinstance(thing, ast.Class):
        return f"```modelica\n{thing.kind} {thing.path}\n```\n{thing.description}"
    prefix = " ".join(word for word in (thing.causality, thing.variability) if word)
    head = f"{prefix} {thing.type} {thing.name}".strip()
    lines = [f"```modelica\n{head}\n```", thing.description]
    variable = view.flat.variables.get(thing.name) if view.flat and found.owner is not None else None
    unit = (variable.unit or variable.inferred_unit) if variable else ""
    if unit:
        lines.append(f"unit: `{unit}`")
    if variable is not None and variable.binding is not None:
        lines.append(f"value: `{variable.binding}`")
    equations = [] if variable is None or view.flat is None else _equations(view.flat, thing.name)
    if equations:
        lines.append("```modelica\n" + "\n".join(equations) + "\n```")
    return "\n\n".join(line for line in lines if line)


def _equations(model: FlatModel, name: str) -> list[str]:
    """Up to three flat equations in which `name` stands alone on a side, or its derivative is."""
    alone = [e for e in model.equations if name in (str(e.lhs), str(e.rhs)) or f"der({name})" in f"{e.lhs} = {e.rhs}"]
    return [f"{e.lhs} = {e.rhs}" for e in alone[:3]]


def occurrences(workspace: Workspace, path: Path, line: int, character: int) -> list[Place]:
    """Every place where what is at the cursor is named, its declaration among them."""
    view = workspace.view(path)
    wanted = declaration(view, line, character)
    if wanted is None:
        return []
    name, found = wanted.element.name, []
    for file in workspace.files(Path(wanted.span.file).resolve() if wanted.span.file else path):
        try:
            text = workspace.text(file)
        except (OSError, UnicodeDecodeError):
            continue
        if name in text:
            found += [(file, span) for span in _named(_reading(workspace, file), name, wanted.span)]
    return found


def _reading(workspace: Workspace, file: Path) -> View:
    """A view without the checks of a whole model."""
    library = BufferedLibrary(workspace.search_path, workspace.texts)
    try:
        own = _within_package(library, file, library.parse_file(file))
    except Diagnostic as finding:
        return View(library, None, [finding])
    return View(library, parsed(file, workspace.text(file), own), [])


def _named(view: View, name: str, declared: Span) -> Iterator[Span]:
    document = view.document
    if document is None:
        return
    tokens = document.tokens
    for k, word in enumerate(tokens.words):
        if word == name and tokens.kinds[k] == "id":
            found = resolve(view.library, document, document.name_of(k))
            if found is not None and _same(found.span, declared):
                yield tokens.span(tokens.offsets[k], len(word))


def _same(a: Span, b: Span) -> bool:
    return (a.line, a.column) == (b.line, b.column) and Path(a.file).resolve() == Path(b.file).resolve()


def completions(workspace: Workspace, path: Path, line: int, character: int) -> dict[str, str]:
    """What may stand at the cursor, with a word on each: components and classes, units inside a unit's quotes."""
    text = workspace.text(path)
    lines = text.split("\n")
    before = "\n".join([*lines[:line], *(row[:character] for row in lines[line : line + 1])])
    if re.search(r'unit\s*=\s*"[^"]*$', before):
        return dict.fromkeys(symbols(), "unit")
    view = _last_that_parsed(workspace, path, before)
    document = view.document
    if document is None:
        return dict.fromkeys(KEYWORDS, "keyword")
    cls = document.class_at(document.offset(line, 0)) or next(iter(document.classes), None)
    if cls is None:
        return dict.fromkeys(KEYWORDS, "keyword")
    dotted = re.search(r"([A-Za-z_]\w*(?:\[[^\]]*\])?(?:\.[A-Za-z_]\w*(?:\[[^\]]*\])?)*)\.\w*$", before)
    modified = re.search(r"([A-Za-z_][\w.]*)\s+[A-Za-z_]\w*\s*\((?:[^()]|\([^()]*\))*$", before.split(";")[-1])
    if dotted:
        return _members(view.library, cls, re.sub(r"\[[^\]]*\]", "", dotted[1]))
    if modified:
        return {n: d for n, d in _members(view.library, cls, modified[1]).items() if d.startswith("parameter")}
    return _in_scope(view.library, cls)


def _last_that_parsed(workspace: Workspace, path: Path, before: str) -> View:
    """The text with the unfinished statement taken out, where it does not parse as it is."""
    view = _reading(workspace, path)
    if view.document is not None:
        return view
    text = workspace.text(path)
    start = before.rfind(";") + 1
    end = text.find("\n", len(before))
    whole = text[:start] + re.sub(r"[^\n]", " ", text[start : end if end >= 0 else len(text)])
    other = Workspace(workspace.search_path)
    other.texts = {**workspace.texts, path: whole + (text[end:] if end >= 0 else "")}
    return _reading(other, path)


def _members(library: Library, cls: ast.Class, dotted: str) -> dict[str, str]:
    found = follow(library, cls, Name(tuple(dotted.split(".")), 0, False))
    inner = type_of(library, found) if found else None
    if inner is None:
        return {}
    own = dict.fromkeys(library.members(inner), "class") if isinstance(found.element, ast.Class) else {}
    return own | _components(library, inner)


def _components(library: Library, cls: ast.Class) -> dict[str, str]:
    listed = [e.element for e in elements(library, cls)]
    return {c.name: f"{c.variability} {c.type}".strip() + (f": {c.description}" if c.description else "")
            for c in listed if not c.protected}  # fmt: skip


def _in_scope(library: Library, cls: ast.Class) -> dict[str, str]:
    found: dict[str, str] = dict.fromkeys(KEYWORDS, "keyword")
    around: ast.Class | None = cls
    while around is not None:
        found |= dict.fromkeys(library.members(around), "class")
        around = around.parent
    found |= dict.fromkeys(library.members(library.root), "class")
    return found | {e.element.name: f"{e.element.variability} {e.element.type}".strip() for e in elements(library, cls)}


def outline(document: Document) -> Mapping[str, object]:
    """Classes and their components, nested."""
    return {cls.name: _outline(document, cls) for cls in document.classes}


def _outline(document: Document, cls: ast.Class) -> dict[str, object]:
    inner = {c.name: _outline(document, c) for c in cls.classes.values() if c.span.file == cls.span.file}
    return {"class": cls, "classes": inner, "components": list(cls.components)}
