"""Component declarations and modifications: Real x[3](start = 1, each fixed = true) = y "text"."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.expressions import ExpressionParser
from lacuna.codegen.syntax.lexer import string_value

_CLOSES = {"(": ")", "{": "}", "[": "]"}
_GRAPHICS = frozenset(
    (
        "Icon", "Diagram", "Placement", "Line", "Dialog", "Text", "choices", "choicesAllMatching", "preferredView",
        "Polygon", "Rectangle", "Ellipse",
    )
)  # fmt: skip
_VARIABILITIES = ("parameter", "constant", "discrete")
_TYPE_PREFIXES = ("flow", "stream", *_VARIABILITIES, "input", "output")
KINDS = ("model", "block", "connector", "record", "type", "package", "function", "class")
CLASS_STARTS = (*KINDS, "partial", "encapsulated", "expandable", "operator", "pure", "impure")


class ModificationParser(ExpressionParser):
    def description(self) -> str:
        """The text after a declaration: "text" + "text"."""
        if self.kind != "str":
            return ""
        text = string_value(self.word)
        self.at += 1
        while self.kind == "+" and self.kinds[self.at + 1] == "str":
            text += string_value(self.words[self.at + 1])
            self.at += 2
        return text

    def element_prefixes(self) -> dict[str, object]:
        """[redeclare] [final] [inner] [outer] [replaceable], in this order (A.2.3)."""
        return dict(self.flags("redeclare", "final", "inner", "outer", "replaceable"))

    def flags(self, *words: str) -> dict[str, bool]:
        """Which of these words stand here, in this order. Raises P021 for one that comes too late or twice."""
        found = {word: self.accept(word) for word in words}
        if self.kind in found:
            hint = f"prefixes stand in this order: {', '.join(words)}"
            raise Diagnostic("P021", f"the prefix '{self.word}' cannot stand here", self.span(), hint)
        return found

    def component_clause(self, prefixes: dict[str, object], single: bool = False) -> list[ast.Component]:
        """flow parameter input TYPE[dims] a(...) = 1 "text", b ...; `single` allows only one component."""
        options = {("redeclares" if k == "redeclare" else k): v for k, v in prefixes.items()}
        self._type_prefixes(options)
        if self.kind != "id" and self.kind != ".":
            raise self.unexpected("a declaration, 'equation', 'algorithm' or 'end'")
        kind, shared = self.sized_type()
        result = []
        while True:
            result.append(self._component(kind, shared, options))
            if single or not self.accept(","):
                break
        constraint = self.constraining_clause(bool(prefixes.get("replaceable")))
        if constraint is not None:
            description = self.description()
            for component in result:
                component.constraint = constraint
                component.description = component.description or description
            if self.kind == "annotation":
                self.annotation()
        return result

    def sized_type(self) -> tuple[ast.Ref, list[ast.Expression]]:
        """The name of a class, and sizes behind it (A.2.4)."""
        written = self.reference()
        if any(written.subscripts[:-1]):
            hint = "sizes stand behind the whole name: A.B[2]"
            raise Diagnostic("P002", f"subscripts inside the name of a class, {written}", written.span, hint)
        name = ast.Ref(written.span, written.names, (None,) * len(written.names), written.absolute)
        return name, list(written.subscripts[-1] or ())

    def type_name(self) -> ast.Ref:
        name, sizes = self.sized_type()
        if sizes:
            hint = f"define a type with these sizes, type T = {name}[...]"
            raise Diagnostic("P002", f"a class is named without subscripts, {name}", name.span, hint)
        return name

    def constraining_clause(self, replaceable: bool = True) -> ast.Extends | None:
        """constrainedby CLASS(...), where it stands here: behind what is replaceable (A.2.2). Raises P021."""
        start = self.at
        if not self.accept("constrainedby"):
            return None
        if not replaceable:
            hint = "write 'replaceable' before the declaration"
            raise Diagnostic("P021", "what is not replaceable has no 'constrainedby'", self.span_from(start), hint)
        bound = self.type_name()
        modification = self.modification() if self.kind == "(" else ast.Modification(bound.span)
        return ast.Extends(bound.span, bound, modification)

    def _type_prefixes(self, options: dict[str, object]) -> None:
        """[flow | stream] [discrete | parameter | constant] [input | output], in this order (A.2.4)."""
        if self.kind in ("flow", "stream"):
            options[self.kind] = True
            self.at += 1
        for name, words in (("variability", _VARIABILITIES), ("causality", ("input", "output"))):
            if self.kind in words:
                options[name] = self.kind
                self.at += 1
        if self.kind in _TYPE_PREFIXES:
            hint = "one of flow, stream; then one of discrete, parameter, constant; then one of input, output"
            raise Diagnostic("P021", f"the prefix '{self.word}' cannot stand here", self.span(), hint)

    def _component(self, kind: ast.Ref, shared: list[ast.Expression], options: dict[str, object]) -> ast.Component:
        start = self.at
        hint_missing = self.kind in ("=", ";", "(") and len(kind.names) == 1
        if hint_missing:
            message = f"a declaration needs a type and a name, found only '{kind}'"
            hint = "write for example Real " + str(kind)
            if self.kind == "=" or self.kind == "(":
                hint += "; an equation belongs under 'equation'"
            raise Diagnostic("P020", message, kind.span, hint)
        name = self.identifier("the name of a component")
        span = self.span(start)
        dimensions = list(self.subscripts()) if self.kind == "[" else []
        modification = self.modification()
        condition = None
        if self.kind == "if":
            self.at += 1
            condition = self.expression()
        description = self.description()
        annotation = self.annotation() if self.kind == "annotation" else None
        return ast.Component(
            span,
            name,
            kind,
            dimensions + shared,
            modification,
            condition,
            description,
            annotation=annotation,
            **options,
        )

    def modification(self, selective: bool = False) -> ast.Modification:
        """(name = value, ...) = value, either part optional; `selective` (of extends) allows break entries."""
        result = ast.Modification(self.span())
        if self.accept("(") and not self.accept(")"):
            self._arguments_into(result, selective)
        if self.kind == ":=":
            raise Diagnostic("P004", "':=' in a declaration", self.span(), "a declaration is bound with =")
        if self.accept("="):
            start = self.at
            result.value = ast.NoValue(self.span(start)) if self.accept("break") else self.expression()
        return result

    def _arguments_into(self, result: ast.Modification, selective: bool = False) -> None:
        self.enter()
        while True:
            if selective and self.accept("break"):
                result.left_out.append(self._connect() if self.kind == "connect" else self.reference())
            else:
                result.arguments.append(self._argument())
            if self.accept(")"):
                break
            if not self.accept(","):
                raise self.unexpected("')' or ','")
        self.leave()

    def _argument(self) -> ast.Argument:
        start = self.at
        flags = self.flags("redeclare", "each", "final", "replaceable")
        if flags["redeclare"] or flags["replaceable"]:
            return self._redeclaration(start, flags)
        name_at = self.at
        names = [self.identifier("the name to modify")]
        while self.accept("."):
            names.append(self.identifier())
        span = self.span(name_at)
        inner = self.modification()
        self.description()
        result = ast.Argument(span, names[-1], inner, flags["each"], flags["final"])
        for name in reversed(names[:-1]):
            result = ast.Argument(span, name, ast.Modification(inner.span, [result]))
        return result

    def _redeclaration(self, start: int, flags: dict[str, bool]) -> ast.Argument:
        if self.kind in CLASS_STARTS:
            new = self.short_class()
            new.replaceable, new.final = flags["replaceable"], flags["final"]
            modification = ast.Modification(new.span)
            return ast.Argument(
                new.span, new.name, modification, flags["each"], flags["final"], new, flags["redeclare"]
            )
        prefixes: dict[str, object] = {"final": flags["final"], "replaceable": flags["replaceable"]}
        component = self.component_clause(prefixes, single=True)[0]
        span: Span = component.span
        return ast.Argument(
            span, component.name, component.modification, flags["each"], flags["final"], component, flags["redeclare"]
        )

    def short_class(self) -> ast.Class:
        """The class definition of a redeclaration: model NAME = OTHER(...) constrainedby BOUND."""
        raise NotImplementedError

    def annotation(self) -> ast.Modification:
        """annotation(...): graphical entries are dropped, the others are kept as a modification."""
        self.at += 1
        result = ast.Modification(self.span())
        self.expect("(")
        while not self.accept(")"):
            if self.kind == "id" and self.word in _GRAPHICS:
                self._skip_entry()
            else:
                result.arguments.append(self._argument())
            if self.kind != ")":
                self.expect(",", "')' or ','")
        return result

    def _skip_entry(self) -> None:
        """Over one entry, to the ',' or ')' that ends it; a ';' is in none."""
        opened: list[int] = []
        while self.kind not in ("eof", ";"):
            if self.kind in _CLOSES:
                opened.append(self.at)
            elif self.kind in _CLOSES.values():
                if not opened:
                    return
                opened.pop()
            elif self.kind == "," and not opened:
                return
            self.at += 1
        if opened:
            error = self.unexpected(f"'{_CLOSES[self.kinds[opened[-1]]]}'")
            error.notes.append((self.span(opened[-1]), "opened here"))
            raise error
