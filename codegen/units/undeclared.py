"""Units of variables that declare none, from equations that leave one choice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.codegen.symbolic.annotated import tells_units
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.leaves import names_in
from lacuna.codegen.units.inference import SECOND, UNKNOWN, Finding, UnitError, UnitInference, over
from lacuna.units import Unit

Sides = tuple[Expr, Expr]


class Undeclared:
    """What is found goes to `units`, of all variables by name; `inference` makes one that reads them."""

    def __init__(self, units: dict[str, Finding], inference: Callable[[], UnitInference]) -> None:
        self.units, self._inference = units, inference

    def infer(self, equations: list[Sides]) -> None:
        """To a fixed point. First from equations without a number that may have a unit itself: what is inferred from
        the others is `soft`."""
        scaled = self._inference().has_written_factor
        sides = [(lhs, rhs, scaled(lhs) or scaled(rhs)) for lhs, rhs in equations if self._is_open(lhs, rhs)]
        self._infer_from([pair for pair in sides if not pair[2]])
        self._infer_from(sides)

    def _infer_from(self, pairs: list[tuple[Expr, Expr, bool]]) -> None:
        """As far as these sides of equations, and whether what they tell is soft, lead."""
        changed = True
        while changed and pairs:
            changed = False
            inference = self._inference()
            rest = []
            for lhs, rhs, soft in pairs:
                try:
                    left, right = (_softer(inference.of(side), soft) for side in (lhs, rhs))
                    solved = self._solve(lhs, right, inference) | self._solve(rhs, left, inference)
                except UnitError:
                    continue
                changed = changed or solved
                if self._is_open(lhs, rhs):
                    rest.append((lhs, rhs, soft))
            pairs = rest

    def _is_open(self, lhs: Expr, rhs: Expr) -> bool:
        return self._has_unknown(lhs) or self._has_unknown(rhs)

    def _has_unknown(self, e: Expr) -> bool:
        return any(self.units.get(name) == UNKNOWN for name in names_in(e))

    def _solve(self, e: Expr, unit: Finding, inference: UnitInference) -> bool:
        """Give the unknown inside `e` the unit that makes `e` have `unit`, where there is exactly one way."""
        if not isinstance(unit, Unit):
            return False
        if e.op == "var":
            if self.units.get(str(e.value)) != UNKNOWN:
                return False
            self.units[str(e.value)] = unit
            return True
        if e.op == "der":
            return self._solve(e.args[0], unit * SECOND, inference)
        if e.op in ("neg", "noEvent", "smooth", "pre"):
            return self._solve(e.args[-1], unit, inference)
        if e.op in ("delay", "annotated"):
            return self._solve(e.value if tells_units(e) else e.args[0], unit, inference)
        if e.op in ("+", "-", "if", "min", "max"):
            parts = e.args[1:] if e.op == "if" else e.args
            solved = [self._solve(a, unit, inference) for a in parts]
            return any(solved)
        if e.op in ("*", "/"):
            return self._solve_product(e, unit, inference)
        return False

    def _solve_product(self, e: Expr, unit: Unit, inference: UnitInference) -> bool:
        a, b = e.args
        known_a, known_b = inference.of(a), inference.of(b)
        if known_b != UNKNOWN and known_a == UNKNOWN:
            inverse = known_b**-1 if isinstance(known_b, Unit) else known_b
            wanted = over(unit, known_b if e.op == "*" else inverse)
            return self._solve(a, wanted, inference)
        if known_a != UNKNOWN and known_b == UNKNOWN:
            wanted = over(unit, known_a) if e.op == "*" else over(known_a, unit)
            return self._solve(b, wanted, inference)
        return False


def _softer(unit: Finding, soft: bool) -> Finding:
    """A unit as it is inferred from an equation."""
    return replace(unit, soft=True) if soft and isinstance(unit, Unit) else unit
