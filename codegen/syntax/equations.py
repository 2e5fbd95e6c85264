"""Equation and algorithm sections."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.cursor import first_of
from lacuna.codegen.syntax.modifications import ModificationParser

SECTION_STARTS = ("equation", "algorithm", "initial", "public", "protected", "annotation", "external")
_BLOCK_ENDS = ("end", "else", "elseif", "elsewhen")


class EquationParser(ModificationParser):
    def section(self) -> ast.Section:
        """equation ... | initial equation ... | algorithm ... up to the next section or `end`."""
        start = self.at
        initial = self.accept("initial")
        algorithm = self.kind == "algorithm"
        if not self.accept("equation", "algorithm"):
            self.errors.append(self.unexpected("'equation' or 'algorithm'"))
            self.at += self.kind == "id"
        self.stray_breaks = []
        section = ast.Section(self.span(start), algorithm, initial, [], self.stray_breaks)
        while self.kind not in (*SECTION_STARTS, "end", "eof") or (self.kind == "initial" and self._is_call()):
            self._item_into(section.items, algorithm, (*SECTION_STARTS, "end"))
        return section

    def _is_call(self) -> bool:
        return self.kinds[self.at + 1] == "("

    def _item_into(self, items: list[ast.Item], algorithm: bool, stop: tuple[str, ...]) -> None:
        start, depth = self.at, self.depth
        self.loops = 0
        try:
            items.append(self._item(algorithm))
        except Diagnostic as error:
            self.depth = depth
            if self.depth > 0 or error.code in ("P009", "P013"):
                raise
            self._skip_block(error, stop, start)

    def _skip_block(self, error: Diagnostic, stop: tuple[str, ...], start: int) -> None:
        """Recovery: a faulty if/for/when block is left behind as a whole."""
        opener = self.kinds[start]
        if opener not in ("if", "for", "when", "while"):
            self.recover(error, stop, start)
            return
        at = start
        while self.kinds[at] != "eof" and (self.kinds[at], self.kinds[at + 1]) != ("end", opener):
            at += 1
        if self.kinds[at] == "eof":
            raise first_of([*self.errors, error])
        self.at = at + 1
        self.recover(error, stop, at)

    def _item(self, algorithm: bool) -> ast.Item:
        self.enter()
        kind, start = self.kind, self.at
        if kind == "if":
            result = self._if(algorithm)
        elif kind == "for":
            self.at += 1
            iterators = self.iterators()
            self.expect("loop", "'loop'")
            result = ast.For(self.span(start), iterators, self._loop(algorithm))
            self._end("for", start)
        elif kind == "when":
            result = self._when(algorithm)
        elif kind == "connect" and not algorithm:
            result = self._connect()
        elif algorithm:
            result = self._statement()
        else:
            result = self._equation()
        if self.kind == "str":
            self.at += 1
        if self.kind == "annotation":
            self.annotation()
        self.semicolon()
        self.leave()
        return result

    def _body(self, algorithm: bool) -> list[ast.Item]:
        items: list[ast.Item] = []
        while self.kind not in _BLOCK_ENDS:
            if self.kind == "eof":
                raise self.unexpected("'end'")
            items.append(self._item(algorithm))
        return items

    def _loop(self, algorithm: bool) -> list[ast.Item]:
        self.loops += 1
        body = self._body(algorithm)
        self.loops -= 1
        return body

    def _end(self, what: str, start: int) -> None:
        if self.kind == "end" and self.kinds[self.at + 1] == what:
            self.at += 2
            return
        error = Diagnostic(
            "P009", f"'end {what}' is missing", self.span(), f"close the '{what}' of line {self.span(start).line}"
        )
        error.notes.append((self.span(start), "opened here"))
        raise error

    def _if(self, algorithm: bool) -> ast.If:
        start = self.at
        self.at += 1
        branches: list[tuple[ast.Expression | None, list[ast.Item]]] = []
        while True:
            condition = self.condition("then")
            branches.append((condition, self._body(algorithm)))
            if not self.accept("elseif"):
                break
        if self.accept("else"):
            branches.append((None, self._body(algorithm)))
        self._end("if", start)
        return ast.If(self.span(start), branches)

    def _when(self, algorithm: bool) -> ast.When:
        start = self.at
        self.at += 1
        branches = []
        while True:
            condition = self.condition("then")
            branches.append((condition, self._body(algorithm)))
            if not self.accept("elsewhen"):
                break
        self._end("when", start)
        return ast.When(self.span(start), branches)

    def _connect(self) -> ast.Connect:
        start = self.at
        self.at += 1
        self.expect("(")
        left = self.reference()
        self.expect(",")
        right = self.reference()
        self.expect(")", "')' or ','")
        return ast.Connect(self.span_from(start), left, right)

    def _equation(self) -> ast.Item:
        start = self.at
        left = self.expression()
        if self.kind == "=":
            self.at += 1
            right = self.expression()
            return ast.Equality(self.span_from(start), left, right, " ".join(self.text_from(start).split()))
        if isinstance(left, ast.Call):
            return ast.Procedure(self.span_from(start), left)
        if isinstance(left, ast.Binary) and left.op == "==" and self.kind in (";", "str", "annotation"):
            hint = "an equation is written with a single ="
            raise Diagnostic("P008", "'==' where an equation belongs", left.span, hint)
        if self.kind == ":=":
            self.semicolon()
        raise self.unexpected("'=' (an equation has two sides)")

    def _statement(self) -> ast.Item:
        start = self.at
        if self.kind == "while":
            self.at += 1
            condition = self.condition("loop")
            body = self._loop(True)
            self._end("while", start)
            return ast.While(self.span(start), condition, body)
        if self.accept("break"):
            if not self.loops:
                self.stray_breaks.append(self.span(start))
            return ast.Break(self.span(start))
        if self.accept("return"):
            return ast.Return(self.span(start))
        target = self.primary()
        if isinstance(target, ast.Call) and self.kind != ":=":
            return ast.Procedure(self.span_from(start), target)
        if not isinstance(target, ast.Ref | ast.Tuple):
            raise Diagnostic("P004", "only a variable can be assigned", self.span(start), "write x := ...;")
        if self.kind != ":=":
            self.semicolon() if self.kind == "=" else None
            raise self.unexpected("':='")
        self.at += 1
        value = self.expression()
        return ast.Assignment(self.span_from(start), target, value, " ".join(self.text_from(start).split()))
