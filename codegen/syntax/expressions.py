"""Expressions, by precedence climbing over the levels of the Modelica grammar."""

from __future__ import annotations

from collections.abc import Callable
from math import isinf

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.arguments import ArgumentParser
from lacuna.codegen.syntax.lexer import string_value

LONGEST_INTEGER = 18  # digits: what 64 bits hold
LARGEST_INTEGER = 2**53 - 1  # from 2^53 on a double does not tell all apart
_RELATIONS = ("<", "<=", ">", ">=", "==", "<>")
_ADDITIVE = ("+", "-", ".+", ".-")
_MULTIPLICATIVE = ("*", "/", ".*", "./")
_POWER = ("^", ".^")

Operand = Callable[[], ast.Expression]


class ExpressionParser(ArgumentParser):
    def expression(self) -> ast.Expression:
        """Any expression, ranges and if-expressions included."""
        self.enter()
        try:
            if self.kind == "if":
                return self._if_expression()
            start = self.at
            first = self._or()
            if self.kind != ":":
                return first
            self.at += 1
            second = self._or()
            if self.accept(":"):
                return ast.Range(self.span_from(start), first, second, self._or())
            return ast.Range(self.span_from(start), first, None, second)
        finally:
            self.leave()

    def _if_expression(self) -> ast.IfExpression:
        start = self.at
        branches = []
        self.at += 1
        while True:
            condition = self.condition("then")
            branches.append((condition, self.expression()))
            if not self.accept("elseif"):
                break
        if self.kind != "else":
            hint = self.slip or "an if-expression has a value in every case: if c then a else b"
            raise Diagnostic("P014", "this if-expression has no 'else'", self.span(start), hint)
        self.at += 1
        otherwise = self.expression()
        return ast.IfExpression(self.span_from(start), branches, otherwise)

    def condition(self, end: str) -> ast.Expression:
        """A condition and the keyword after it."""
        result = self.expression()
        if self.kind == "=":
            raise Diagnostic("P008", "'=' in a condition", self.span(), "compare with ==")
        if self.kind != end:
            raise self.unexpected(f"'{end}' or an operator")
        self.at += 1
        return result

    def _chain(self, operators: tuple[str, ...], left: ast.Expression, operand: Operand) -> ast.Expression:
        """left op operand op operand ..., grouped from the left."""
        operands = 1
        while self.kind in operators:
            span, op = self.span(), self.kind
            self.at += 1
            self._no_sign()
            left = ast.Binary(span, op, left, operand())
            operands += 1
            self.refuse_long(operands)
        return left

    def _or(self) -> ast.Expression:
        return self._chain(("or",), self._and(), self._and)

    def _and(self) -> ast.Expression:
        return self._chain(("and",), self._not(), self._not)

    def _not(self) -> ast.Expression:
        if self.kind == "not":
            span = self.span()
            self.at += 1
            return ast.Unary(span, "not", self._relation())
        return self._relation()

    def _relation(self) -> ast.Expression:
        left = self._sum()
        if self.kind not in _RELATIONS:
            return left
        span, op = self.span(), self.kind
        self.at += 1
        result = ast.Binary(span, op, left, self._sum())
        if self.kind in _RELATIONS:
            hint = "join two comparisons: a < b and b < c"
            raise Diagnostic("P015", "comparisons cannot be chained", self.span(), hint)
        return result

    def _sum(self) -> ast.Expression:
        if self.kind in _ADDITIVE:
            span, op = self.span(), self.kind
            self.at += 1
            self._no_sign()
            left: ast.Expression = ast.Unary(span, op, self._product())
        else:
            left = self._product()
        return self._chain(_ADDITIVE, left, self._product)

    def _product(self) -> ast.Expression:
        return self._chain(_MULTIPLICATIVE, self._power(), self._power)

    def _power(self) -> ast.Expression:
        base = self.primary()
        if self.kind not in _POWER:
            return base
        span, op = self.span(), self.kind
        self.at += 1
        self._no_sign()
        result = ast.Binary(span, op, base, self.primary())
        if self.kind in _POWER:
            raise Diagnostic("P015", "powers cannot be chained", self.span(), "use parentheses: (a^b)^c")
        return result

    def _no_sign(self) -> None:
        if self.kind in _ADDITIVE and self.words[self.at - 1] not in ("and", "or"):
            hint = "put the signed part in parentheses, such as a*(-b)"
            raise Diagnostic("P016", f"a sign directly after '{self.words[self.at - 1]}'", self.span(), hint)

    def _number(self, word: str, at: int) -> int | float:
        if word.isdigit():
            if len(word) > LONGEST_INTEGER:
                hint = "Integers have 32 bits in most tools; write a Real, such as 1e20"
                raise Diagnostic("P030", f"an Integer of {len(word)} digits", self.span(at), hint)
            if int(word) > LARGEST_INTEGER:
                hint = "an Integer is exact up to 2^53 - 1; write a Real, such as 1e16"
                raise Diagnostic("P030", f"the Integer {word} is beyond 2^53 - 1", self.span(at), hint)
            return int(word)
        if isinf(value := float(word)):
            raise Diagnostic(
                "P030", f"{word[:20]} is beyond the largest Real number", self.span(at), "at most 1.79e308"
            )
        return value

    def primary(self) -> ast.Expression:
        start, kind = self.at, self.kind
        if kind == "num":
            self.at += 1
            return ast.Literal(self.span(start), self._number(self.words[start], start))
        if kind == "str":
            self.at += 1
            return ast.Literal(self.span(start), string_value(self.words[start]))
        if kind in ("true", "false"):
            self.at += 1
            return ast.Literal(self.span(start), kind == "true")
        if kind in ("id", "."):
            return self._reference_or_call()
        if kind in ("der", "initial", "pure"):
            self.at += 1
            return self.call(ast.Ref(self.span(start), (kind,), (None,)), start)
        if kind == "(":
            return self._parenthesised()
        if kind == "{":
            return self._braces()
        if kind == "[":
            return self._matrix()
        if kind == "end":
            self.at += 1
            return ast.End(self.span(start))
        raise self._no_expression()

    def _no_expression(self) -> Diagnostic:
        if self.kind == "if":
            hint = "put the if-expression in parentheses: 2*(if c then a else b)"
            return Diagnostic("P007", "an if-expression cannot be an operand as it stands", self.span(), hint)
        found = self.word if self.kind == "eof" else f"'{self.word}'"
        hint = "'=' compares nothing: use ==" if self.kind == "=" else f"say what comes after {self.words[self.at - 1]}"
        return Diagnostic("P007", f"an expression is missing before {found}", self.span(), hint)

    def reference(self) -> ast.Ref:
        """A component reference: names with subscripts."""
        start = self.at
        absolute = self.accept(".")
        names = [self.identifier()]
        subscripts = [self._subscripts()]
        while self.kind == ".":
            self.at += 1
            names.append(self.identifier("a name after '.'"))
            subscripts.append(self._subscripts())
        return ast.Ref(self.span_from(start), tuple(names), tuple(subscripts), absolute)

    def _subscripts(self) -> tuple[ast.Expression, ...] | None:
        return tuple(self.subscripts()) if self.kind == "[" else None

    def subscripts(self) -> list[ast.Expression]:
        """[2, :, i + 1]"""
        self.expect("[")
        result = []
        while True:
            if self.kind == ":":
                result.append(ast.Colon(self.span()))
                self.at += 1
            else:
                result.append(self.expression())
            if not self.accept(","):
                break
        self.expect("]", "']' or ','")
        return result

    def _reference_or_call(self) -> ast.Expression:
        start = self.at
        reference = self.reference()
        return self.call(reference, start) if self.kind == "(" else reference

    def maybe_comprehension(self) -> ast.Expression:
        start = self.at
        body = self.expression()
        if self.kind != "for":
            return body
        self.at += 1
        iterators = self.iterators()
        return ast.Comprehension(self.span_from(start), body, iterators)

    def iterators(self) -> list[ast.Iterator]:
        """i in 1:n, j in 1:m, or k: what k runs over follows from what it indexes"""
        result = []
        while True:
            start = self.at
            name = self.identifier("the loop variable")
            bounds = self.expression() if self.accept("in") else None
            result.append(ast.Iterator(self.span_from(start), name, bounds))
            if not self.accept(","):
                return result

    def _parenthesised(self) -> ast.Expression:
        start = self.at
        self.at += 1
        items: list[ast.Expression | None] = []
        while True:
            items.append(None if self.kind in (",", ")") else self.expression())
            if not self.accept(","):
                break
        self.expect(")", "')' or an operator")
        if len(items) == 1 and items[0] is not None:
            return self._part(items[0], start)
        return ast.Tuple(self.span_from(start), items)

    def _part(self, whole: ast.Expression, start: int) -> ast.Expression:
        """What is in parentheses, or the elements of it that follow: (e)[1], (e).name (A.2.7)."""
        if self.kind == "[":
            return ast.Part(self.span(start), whole, tuple(self.subscripts()))
        if self.accept("."):
            return ast.Part(self.span(start), whole, name=self.identifier("a name after '.'"))
        return whole

    def _braces(self) -> ast.Expression:
        start = self.at
        self.at += 1
        if self.kind == "}":
            hint = "for an empty array write zeros(0)"
            raise Diagnostic("P007", "an array needs at least one element", self.span(), hint)
        elements = [self.maybe_comprehension()]
        while self.accept(","):
            elements.append(self.maybe_comprehension())
        self.expect("}", "'}' or ','")
        if isinstance(elements[0], ast.Comprehension) and len(elements) == 1 and not elements[0].braces:
            elements[0].braces = True
            return elements[0]
        return ast.ArrayLiteral(self.span_from(start), elements)

    def _matrix(self) -> ast.MatrixLiteral:
        start = self.at
        self.at += 1
        rows = [[self.expression()]]
        while self.kind in (",", ";"):
            if self.accept(","):
                rows[-1].append(self.expression())
            else:
                self.at += 1
                rows.append([self.expression()])
        self.expect("]", "']', ',' or ';'")
        return ast.MatrixLiteral(self.span_from(start), rows)
