"""The arguments of calls: by position, by name, and functions with some of their inputs given."""

from __future__ import annotations

from abc import abstractmethod

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.cursor import Cursor

_REDUCTIONS = ("sum", "product", "min", "max", "array")  # what takes `e for i in r` (10.3.4.1)


class ArgumentParser(Cursor):
    @abstractmethod
    def expression(self) -> ast.Expression: ...

    @abstractmethod
    def reference(self) -> ast.Ref: ...

    @abstractmethod
    def type_name(self) -> ast.Ref: ...

    @abstractmethod
    def maybe_comprehension(self) -> ast.Expression: ...

    def call(self, function: ast.Ref, start: int) -> ast.Call:
        self.expect("(")
        call = ast.Call(function.span, function, [])
        if not self.accept(")"):
            self._arguments(call)
        call.span = self.span_from(start)
        return call

    def _arguments(self, call: ast.Call) -> None:
        while True:
            if self.kind == "id" and self.kinds[self.at + 1] == "=":
                self._named_argument(call.named)
            elif call.named:
                hint = "arguments by position come before those by name"
                raise Diagnostic("P017", "an argument by position after one by name", self.span(), hint)
            elif self.kind == "function":
                call.args.append(self._partial_function())
            else:
                call.args.append(self._by_position(call))
            if self.accept(")"):
                return
            if not self.accept(","):
                raise self.unexpected("')' or ','")

    def _by_position(self, call: ast.Call) -> ast.Expression:
        """One argument by position; e for i in r is one of reductions, alone."""
        braces = self.kind == "{"
        found = self.maybe_comprehension()
        plain = str(call.function).removeprefix(".") in _REDUCTIONS and not call.args
        if isinstance(found, ast.Comprehension) and not braces and not plain:
            hint = "put it in braces: {e for i in r}"
            raise Diagnostic("P017", f"{call.function} takes no iterators", found.span, hint)
        return found

    def _named_argument(self, named: dict[str, ast.Expression]) -> None:
        name, span = self.word, self.span()
        self.at += 2
        if name in named:
            raise Diagnostic("P017", f"the argument {name} is given twice", span, "keep one of them")
        named[name] = self._partial_function() if self.kind == "function" else self.expression()

    def _partial_function(self) -> ast.PartialFunction:
        """function NAME(a = 1, b = 2)"""
        start = self.at
        self.at += 1
        result = ast.PartialFunction(self.span(start), self.type_name())
        self.expect("(")
        while not self.accept(")"):
            if self.kind != "id" or self.kinds[self.at + 1] != "=":
                raise self.unexpected("an input by name, such as a = 1")
            self._named_argument(result.named)
            if self.kind != ")":
                self.expect(",", "')' or ','")
        result.span = self.span_from(start)
        return result
