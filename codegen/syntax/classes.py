"""Class definitions: declarations, imports, extends, modifications, annotations."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.cursor import first_of
from lacuna.codegen.syntax.equations import SECTION_STARTS, EquationParser
from lacuna.codegen.syntax.lexer import string_value, tokenize
from lacuna.codegen.syntax.modifications import CLASS_STARTS, KINDS

_PREFIXES = ("encapsulated", "partial", "expandable", "pure", "impure", "operator")  # in this order (A.2.2)
_KINDS_OF = {"expandable": "connector", "pure": "function", "impure": "function", "operator": "record function"}


def parse(text: str, file: str) -> list[ast.Class]:
    """The classes of one file, with `within` noted on each. Raises the first Diagnostic, which carries the others."""
    return ClassParser(tokenize(text, file)).file()


class ClassParser(EquationParser):
    def file(self) -> list[ast.Class]:
        within = ""
        if self.accept("within"):
            if self.kind != ";":
                within = str(self.type_name())
            self.semicolon()
        classes = []
        while self.kind != "eof":
            self.accept("final")
            if self.kind not in CLASS_STARTS:
                raise first_of([*self.errors, self._no_class()])
            start = self.at
            try:
                found = self.class_definition()
                self.semicolon()
                found.within = within
                self._refuse_twice(found, {c.name: c for c in classes})
                classes.append(found)
            except Diagnostic as error:
                if error in self.errors:
                    raise
                self.recover(error, CLASS_STARTS, start)
        if self.errors:
            raise first_of(self.errors)
        if not classes:
            hint = "a .mo file holds a class: model NAME ... end NAME;"
            raise Diagnostic("P019", "the file holds no class", self.source.span(0), hint)
        return classes

    def _no_class(self) -> Diagnostic:
        wanted = "a class ('model', 'package', 'connector', 'function' ...)"
        if self.kind == "end":
            hint = "there is one 'end' too many above, or a class closed too early"
            return Diagnostic("P009", "'end' closes nothing here", self.span(), hint)
        return self.unexpected(wanted)

    def class_definition(self) -> ast.Class:
        """[partial] model NAME ... end NAME (without the semicolon)."""
        self.enter()
        start = self.at
        kind, prefixes = self._class_prefixes()
        same = self.accept("extends")
        cls = ast.Class(self.span(), kind, self.identifier("the name of the class"), **prefixes)
        if same:
            cls.extends_same = self.modification() if self.kind == "(" else ast.Modification(cls.span)
            self._long_definition(cls, start)
        elif self.accept("="):
            self._short_definition(cls)
        else:
            self._long_definition(cls, start)
        self.leave()
        return cls

    def _class_prefixes(self) -> tuple[str, dict[str, bool]]:
        """The kind of a class definition, and what stands before it."""
        start = self.at
        found = {word: True for word, stands in self.flags(*_PREFIXES).items() if stands}
        kinds = [k for word in found for k in (_KINDS_OF.get(word, self.kind),) if self.kind not in k.split()]
        if kinds and self.kind in KINDS:
            hint = f"it stands before {' or '.join(kinds[0].split())}"
            message = f"a prefix of this {self.kind} belongs to another kind of class"
            raise Diagnostic("P021", message, self.span_from(start), hint)
        found.pop("pure", None)
        if self.kind not in KINDS:
            if found.get("operator"):
                return "operator", found
            raise self.unexpected("'model', 'block', 'connector', 'record', 'type', 'package' or 'function'")
        self.at += 1
        return self.words[self.at - 1], found

    def short_class(self) -> ast.Class:
        kind, prefixes = self._class_prefixes()
        cls = ast.Class(self.span(), kind, self.identifier("the name of the class"), **prefixes)
        self.expect("=")
        self._short_definition(cls)
        cls.constraint = self.constraining_clause()
        cls.description = cls.description or self.description()
        if self.kind == "annotation":
            self.annotation()
        return cls

    def _short_definition(self, cls: ast.Class) -> None:
        start = self.at
        if self.accept("enumeration"):
            cls.literals = self._enumeration()
        elif self.kind == "der":
            cls.derivative_of = self._derivative_of()
        else:
            causality = self.word if self.accept("input", "output") else ""
            base, dimensions = self.sized_type()
            modification = self.modification() if self.kind == "(" else ast.Modification(self.span(start))
            causality = self.words[start] if causality else ""
            cls.alias = ast.Alias(base.span, base, dimensions, modification, causality)
        cls.description = self.description()
        if self.kind == "annotation":
            cls.annotation = self.annotation()

    def _derivative_of(self) -> tuple[ast.Ref, tuple[str, ...]]:
        """der(f, x, y): the partial derivative of a function by its inputs."""
        self.at += 1
        self.expect("(")
        function, inputs = self.type_name(), []
        while self.accept(","):
            inputs.append(self.identifier("an input of the function"))
        self.expect(")", "')' or ','")
        return function, tuple(inputs)

    def _enumeration(self) -> tuple[tuple[str, str], ...]:
        self.expect("(")
        literals = []
        while True:
            if not literals and self.accept(":"):
                break
            name = self.identifier("a literal of the enumeration")
            literals.append((name, self.description()))
            if self.kind == "annotation":
                self.annotation()
            if not self.accept(","):
                break
        self.expect(")", "')' or ','")
        return tuple(literals)

    def _long_definition(self, cls: ast.Class, start: int) -> None:
        cls.description = self.description()
        depth = self.depth
        self.depth = 0
        protected = False
        while self.kind not in ("end", "eof"):
            if self.accept("public"):
                protected = False
            elif self.accept("protected"):
                protected = True
            elif self.kind == "annotation":
                self._own_annotation(cls)
                self.semicolon()
            elif self.kind in ("equation", "algorithm", "initial"):
                cls.sections.append(self.section())
            elif self.kind == "external":
                self._external(cls)
            else:
                self._element_into(cls, protected)
        self.depth = depth
        self._end_class(cls, start)

    def _own_annotation(self, cls: ast.Class) -> None:
        """Of two, which one holds would be open."""
        before, start = cls.annotation, self.at
        cls.annotation = self.annotation()
        if before is not None:
            hint = "write one, at the end of the class"
            error = Diagnostic("P022", f"{cls.name} has two annotations", self.span_from(start), hint)
            error.notes.append((before.span, "the first one"))
            raise error

    def _end_class(self, cls: ast.Class, start: int) -> None:
        if self.kind == "eof":
            error = Diagnostic("P009", f"'end {cls.name};' is missing", self.span(), f"close {cls.kind} {cls.name}")
            error.notes.append((cls.span, "opened here"))
            raise first_of([*self.errors, error])
        self.at += 1
        if self.kind in ("if", "for", "when", "while"):
            message = f"'end {self.kind}' without its '{self.kind}'"
            raise first_of([*self.errors, Diagnostic("P009", message, self.span(), "remove it, or open the block")])
        if self.kind != "id" or self.word != cls.name:
            error = Diagnostic(
                "P005", f"'end {self.word}' closes {cls.kind} {cls.name}", self.span(), f"write end {cls.name};"
            )
            error.notes.append((cls.span, "the name given here"))
            raise first_of([*self.errors, error])
        self.at += 1

    def _external(self, cls: ast.Class) -> None:
        """external "C" y = f(x, y) annotation(...);"""
        span = self.span()
        self.at += 1
        language = "C"
        if self.kind == "str":
            language = string_value(self.word)
            self.at += 1
        cls.external = ast.External(span, language)
        if self.kind in ("id", "."):
            called = self.primary()
            if self.accept("="):
                if not isinstance(called, ast.Ref):
                    raise Diagnostic("P003", "expected a variable before '='", called.span, "y = f(x)")
                cls.external.result, called = called, self.primary()
            if not isinstance(called, ast.Call):
                raise Diagnostic("P003", "expected a call of the external function", called.span, "write f(x)")
            cls.external.function, cls.external.args = str(called.function), called.args
        if self.kind == "annotation":
            cls.external.annotation = self.annotation()
        self.semicolon()

    def _element_into(self, cls: ast.Class, protected: bool) -> None:
        start = self.at
        errors = len(self.errors)
        try:
            self._element(cls, protected)
        except Diagnostic as error:
            if len(self.errors) > errors or error in self.errors or error.code in ("P009", "P005", "P013"):
                raise
            self.depth = 0
            self.recover(error, (*SECTION_STARTS, "end"), start)

    def _element(self, cls: ast.Class, protected: bool) -> None:
        if self.kind == "import":
            cls.imports += self._import()
        elif self.kind == "extends":
            self.at += 1
            base = self.type_name()
            modification = self.modification(selective=True) if self.kind == "(" else ast.Modification(base.span)
            if self.kind == "annotation":
                self.annotation()
            cls.extends.append(ast.Extends(base.span, base, modification, protected))
        else:
            prefixes = self.element_prefixes()
            prefixes["protected"] = protected
            if self.kind in CLASS_STARTS:
                self._nested_class(cls, prefixes)
            else:
                cls.components.extend(self.component_clause(prefixes))
        self.semicolon()

    def _nested_class(self, cls: ast.Class, prefixes: dict[str, object]) -> None:
        nested = self.class_definition()
        nested.parent = cls
        nested.redeclares = bool(prefixes.pop("redeclare"))
        for name, written in prefixes.items():
            setattr(nested, name, written)
        nested.constraint = self.constraining_clause(nested.replaceable)
        if nested.constraint is not None:
            nested.description = nested.description or self.description()
            if self.kind == "annotation":
                self.annotation()
        self._refuse_twice(nested, cls.classes)
        cls.classes[nested.name] = nested

    @staticmethod
    def _refuse_twice(found: ast.Class, others: dict[str, ast.Class]) -> None:
        if found.name in others:
            error = Diagnostic("R010", f"{found.name} is declared twice", found.span, "rename one of them")
            error.notes.append((others[found.name].span, "the other declaration"))
            raise error

    def _import(self) -> list[ast.Import]:
        """import A.B; import C = A.B; import A.*; import A.{B, C};"""
        start = self.at
        self.at += 1
        alias = ""
        if self.kind == "id" and self.kinds[self.at + 1] == "=":
            alias = self.word
            self.at += 2
        names = [self.identifier()]
        every, listed = False, [""]
        while self.kind in (".", ".*"):
            if self.accept(".*"):
                every = True
                break
            self.at += 1
            if self.kind == "{":
                listed = self._import_list()
                break
            names.append(self.identifier())
        span = self.span_from(start)
        self.description()
        if self.kind == "annotation":
            self.annotation()
        paths = [(*names, name) if name else tuple(names) for name in listed]
        return [ast.Import(span, ast.Ref(span, path, (None,) * len(path)), alias, every) for path in paths]

    def _import_list(self) -> list[str]:
        self.at += 1
        names = [self.identifier()]
        while self.accept(","):
            names.append(self.identifier())
        self.expect("}", "'}' or ','")
        return names
