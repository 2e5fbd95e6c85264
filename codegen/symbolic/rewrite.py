"""Apply one rewriting of expressions to everything in a flat model: equations, statements, attributes, functions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.annotated import OP, DerivativeRule, meant_by, plain, tells_units, unmarked
from lacuna.codegen.symbolic.expr import FALSE, TRUE, Expr, neg, transform

Rule = Callable[[Expr], Expr | None]
Branch = tuple[Expr, list[flat.Statement]]
Target = Callable[[str], tuple[str, int]]  # name -> (name, sign)


def _same(name: str) -> tuple[str, int]:
    return name, 1


class Rewriter:
    """`rule(node)` gives the replacement of a node or None; `target(name)` renames assigned variables."""

    def __init__(self, rule: Rule, target: Target = _same):
        self._rule, self._target = rule, target
        self._memo: dict[Expr, Expr] = {}

    def expression(self, e: Expr) -> Expr:
        return transform(e, self._rule, self._memo)

    def _assign(self, s: flat.Assign | flat.Reinit) -> flat.Statement:
        name, sign = self._target(s.target)
        value = self.expression(s.value)
        return replace(s, target=name, value=neg(value) if sign < 0 else value)

    def statement(self, s: flat.Statement) -> flat.Statement:
        match s:
            case flat.Assign() | flat.Reinit():
                return self._assign(s)
            case flat.AssignCall():
                return replace(s, value=self.expression(s.value))
            case flat.AssignElement():
                indices = tuple(map(self.expression, s.indices))
                return replace(s, indices=indices, value=self.expression(s.value))
            case flat.Assert():
                return replace(s, condition=self.expression(s.condition))
            case flat.If():
                return replace(s, branches=self._branches(s.branches))
            case flat.When():
                return replace(s, branches=[(self.expression(c), self.statements(b)) for c, b in s.branches])
            case flat.While():
                return replace(s, condition=self.expression(s.condition), body=self.statements(s.body))
            case flat.For():
                first, step, last = map(self.expression, (s.first, s.step, s.last))
                return replace(s, first=first, step=step, last=last, body=self.statements(s.body))
        return s

    def _branches(self, branches: Sequence[Branch]) -> list[Branch]:
        """Those that may be taken: none whose condition comes to be false, none behind one that always holds."""
        found: list[Branch] = []
        for condition, body in branches:
            settled = self.expression(condition)
            if settled is not FALSE:
                found.append((settled, self.statements(body)))
            if settled is TRUE:
                break
        return found

    def statements(self, body: Iterable[flat.Statement]) -> list[flat.Statement]:
        result: list[flat.Statement] = []
        for s in map(self.statement, body):
            if not isinstance(s, flat.If):
                result.append(s)
            elif s.branches and s.branches[0][0] is TRUE:
                result += s.branches[0][1]
            elif s.branches:
                result.append(s)
        return result

    def equation(self, e: flat.Equation) -> flat.Equation:
        lhs, rhs = self.expression(e.lhs), self.expression(e.rhs)
        return e if lhs is e.lhs and rhs is e.rhs else replace(e, lhs=lhs, rhs=rhs)

    def variable(self, v: flat.Variable) -> flat.Variable:
        fields = ("binding", "start", "fixed", "min", "max", "nominal")
        given = {f: e for f in fields if (e := getattr(v, f)) is not None}
        changed = {f: new for f, e in given.items() if (new := self.expression(e)) is not e}
        return replace(v, **changed) if changed else v

    def _algorithm(self, a: flat.Algorithm) -> flat.Algorithm:
        targets = tuple(self._target(name)[0] for name in a.targets)
        return replace(a, statements=self.statements(a.statements), targets=targets)

    def model(self, model: flat.FlatModel) -> flat.FlatModel:
        """A copy with everything rewritten but functions (their names are their own)."""
        return replace(
            model,
            variables={n: self.variable(v) for n, v in model.variables.items()},
            equations=[self.equation(e) for e in model.equations],
            initial_equations=[self.equation(e) for e in model.initial_equations],
            whens=[self.statement(w) for w in model.whens],
            algorithms=[self._algorithm(a) for a in model.algorithms],
            asserts=[self.statement(a) for a in model.asserts],
            derivatives={key: [self._derivative(r) for r in rules] for key, rules in model.derivatives.items()},
        )

    def _derivative(self, rule: DerivativeRule) -> DerivativeRule:
        return rule if isinstance(rule.value, Exception) else replace(rule, value=self.expression(rule.value))


def without_marks(model: flat.FlatModel) -> flat.FlatModel:
    """The model without what tells the units of numbers, and derivatives outside of equations: nobody asks for them."""
    settled = Rewriter(lambda n: plain(n) if n.op == OP or meant_by(n) is not None else None).model(model)
    equations = Rewriter(lambda n: unmarked(n) if tells_units(n) or meant_by(n) is not None else None)
    return replace(settled, equations=[equations.equation(e) for e in model.equations], derivatives=model.derivatives)


def assigned(body: Iterable[flat.Statement]) -> list[str]:
    """Names of the variables that statements assign, in order of first assignment (reinit not counted)."""
    names: dict[str, None] = {}
    for s in body:
        match s:
            case flat.Assign() | flat.AssignElement():
                names[s.target] = None
            case flat.AssignCall():
                names.update((t, None) for t in s.targets if t is not None)
            case flat.If() | flat.When():
                for _, inner in s.branches:
                    names.update((n, None) for n in assigned(inner))
            case flat.While() | flat.For():
                names.update((n, None) for n in assigned(s.body))
    return list(names)


def all_statements(body: Iterable[flat.Statement]) -> Iterable[flat.Statement]:
    """Every statement, those inside others after them."""
    for s in body:
        yield s
        if isinstance(s, flat.If | flat.When):
            for _, inner in s.branches:
                yield from all_statements(inner)
        elif isinstance(s, flat.While | flat.For):
            yield from all_statements(s.body)


def expressions(body: Iterable[flat.Statement]) -> Iterable[Expr]:
    """Every expression read by statements."""
    for s in body:
        match s:
            case flat.Assign() | flat.Reinit() | flat.AssignCall():
                yield s.value
            case flat.AssignElement():
                yield from (*s.indices, s.value)
            case flat.Assert():
                yield s.condition
            case flat.If() | flat.When():
                for condition, inner in s.branches:
                    yield condition
                    yield from expressions(inner)
            case flat.While():
                yield s.condition
                yield from expressions(s.body)
            case flat.For():
                yield from (s.first, s.step, s.last)
                yield from expressions(s.body)
