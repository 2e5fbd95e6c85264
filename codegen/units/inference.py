"""Units of expressions, bottom up. A literal adapts to its neighbours; an unknown unit makes no claim.

In a product a literal is a plain number of unknown scale (it may convert); added or compared it takes the
unit of the other operand. What does not agree for it is a warning: the number may have a unit (as in `10*sin(314*time)`
volts), which the language gives no place to write. So is what disagrees with a unit that was inferred beside such a
number (`soft`), and `time` by itself, as in `sin(time)`, which is a number of seconds to those who write so.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from lacuna.codegen.symbolic.annotated import meant_by, tells_units
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, RELATIONS, Expr, to_text
from lacuna.units import DIMENSIONLESS, Unit, format_unit, parse_unit

SECOND = parse_unit("s")
_COUNT = Unit(DIMENSIONLESS.exponents, None)

Finding = Unit | str  # a unit, or one of the two below
LITERAL, UNKNOWN = "literal", "unknown"

_ANGLE_FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "log10")


class UnitError(Exception):
    """Two parts of an expression that do not go together; a warning where a number that is written there may be what
    brings them together."""

    def __init__(self, code: str, message: str, hint: str, severity: str = "error") -> None:
        super().__init__(message)
        self.code, self.message, self.hint, self.severity = code, message, hint, severity


def short(e: Expr) -> str:
    text = to_text(meant_by(e) or e)
    return text if len(text) <= 70 else text[:67] + "..."


class UnitInference:
    """`of(e)` is the unit of an expression; `variable(name)` gives those of variables. Memoised: one object a pass."""

    def __init__(self, variable: Callable[[Expr], Finding], function: Callable[[str], str]) -> None:
        self._variable, self._function = variable, function
        self._memo: dict[Expr, Finding] = {}
        self._scaled: dict[Expr, bool] = {}

    def of(self, e: Expr) -> Finding:
        """Raises UnitError where units inside `e` contradict each other."""
        found = self._memo.get(e)
        if found is None:
            found = self._memo[e] = self._infer(e)
        return found

    def _infer(self, e: Expr) -> Finding:
        op = e.op
        if op == "const":
            meant = meant_by(e)
            return LITERAL if meant is None else self.of(meant)
        if op == "var":
            return self._variable(e)
        if op == "time":
            return SECOND
        if op == "der":
            return over(self.of(e.args[0]), SECOND)
        if op in ("+", "-", "min", "max"):
            return self.common(e.args, e, "added" if op in "+-" else f"compared by {op}")
        if op in RELATIONS:
            self.common(e.args, e, "compared")
            return UNKNOWN
        if op == "*":
            return times(self.of(e.args[0]), self.of(e.args[1]))
        if op == "/":
            return over(self.of(e.args[0]), self.of(e.args[1]))
        if op == "^":
            return self._power(e)
        if op == "if":
            self.of(e.args[0])
            return self.common(e.args[1:], e, "alternatives")
        if op == "sample":
            for a in e.args:
                self.require(a, SECOND, "sample takes times")
            return UNKNOWN
        if op == "call":
            return self._call(e)
        if op == "spatialDistribution":  # which result, in0, in1, x, positiveVelocity, points, values
            self._all(e.args[3:5])
            return self.common(e.args[1:3], e, "in0 and in1")
        if op == "delay":
            for a in e.args[1:]:
                self.require(a, SECOND, "delay takes a time")
            return self.of(e.args[0])
        if op == "annotated":
            return self.of(e.value if tells_units(e) else e.args[0])
        for a in e.args[:-1]:
            self.of(a)
        return self.of(e.args[-1]) if e.args and e.type != BOOLEAN else self._all(e.args)

    def _all(self, args: tuple[Expr, ...]) -> Finding:
        for a in args:
            self.of(a)
        return UNKNOWN

    def common(self, args: tuple[Expr, ...], e: Expr, how: str) -> Finding:
        """The one unit of operands that must agree."""
        result: Finding = LITERAL
        first: Expr | None = None
        for a in args:
            found = self.of(a)
            if isinstance(found, Unit):
                if isinstance(result, Unit):
                    if not result.same(found):
                        raise self.disagreement("U002", f"{how} in {short(e)}", first, result, a, found)
                    if result.factor is None or (result.soft and found.factor is not None):
                        result = found
                else:
                    result, first = found, a
            elif result == LITERAL:
                result = found
        return result

    def require(self, e: Expr, unit: Unit, why: str) -> None:
        found = self.of(e)
        if isinstance(found, Unit) and not found.same(unit):
            scaled = self.has_written_factor(e)
            if unit.dimensionless and scaled and e.op != "time":
                return
            hint = "divide by a quantity of the same unit" if unit.dimensionless else f"it needs the unit {unit}"
            severity = "warning" if scaled or found.soft else "error"
            raise UnitError("U003", f"{why}; {short(e)} is in {found}", hint, severity)

    def _power(self, e: Expr) -> Finding:
        base, exponent = e.args
        found = self.of(base)
        self.require(exponent, DIMENSIONLESS, "an exponent is a number")
        if not isinstance(found, Unit) or found.dimensionless:
            return found
        if exponent.op != "const":
            hint = "divide the base by a quantity of the same unit"
            severity = "warning" if found.soft or self.has_written_factor(base) else "error"
            raise UnitError(
                "U003", f"{short(base)} is in {found}, its exponent {short(exponent)} varies", hint, severity
            )
        return found ** Fraction(exponent.value).limit_denominator(1000)

    def _call(self, e: Expr) -> Finding:
        name, args = str(e.value), e.args
        if name == "sqrt":
            found = self.of(args[0])
            return found ** Fraction(1, 2) if isinstance(found, Unit) else found
        if name in _ANGLE_FUNCTIONS:
            self.require(args[0], DIMENSIONLESS, f"{name} takes a number without unit")
            return LITERAL if self.of(args[0]) == LITERAL else DIMENSIONLESS
        if name in ("abs", "floor", "ceil"):
            return self.of(args[0])
        if name in ("sign", "integer"):
            self.of(args[0])
            return DIMENSIONLESS
        if name in ("mod", "rem", "atan2", "div"):
            found = self.common(args, e, f"arguments of {name}")
            return found if name in ("mod", "rem") else DIMENSIONLESS
        if name == "[]":
            return self.of(args[0])
        self._all(args)
        declared = self._function(name)
        return parse_unit(declared) if declared else UNKNOWN

    def disagreement(self, code: str, how: str, a: Expr, unit_a: Unit, b: Expr, unit_b: Unit) -> UnitError:
        """Both sides with their units, and the factor between them."""
        message = f"units differ, {how}: {short(a)} is in {unit_a}, {short(b)} is in {unit_b}"
        if unit_a.exponents == unit_b.exponents:
            return UnitError("U004", message, f"one is {unit_a.factor / unit_b.factor:.6g} times the other: convert it")
        ratio = unit_a / unit_b
        if scaled := [side for side in (a, b) if self.has_written_factor(side)]:
            missing = format_unit(Unit((ratio if scaled[0] is b else ratio**-1).exponents))
            hint = f"if a number there is in {missing}, make it a parameter with that unit; or correct a declared unit"
            return UnitError(code, message, hint, "warning")
        if unit_a.soft or unit_b.soft:
            hint = "declare the unit that was inferred here beside a number, or correct one"
            return UnitError(code, message, hint, "warning")
        missing = format_unit(Unit(ratio.exponents))
        return UnitError(code, message, f"multiply {short(b)} by a quantity in {missing}, or correct a declared unit")

    def has_written_factor(self, e: Expr) -> bool:
        """Whether a number that somebody wrote scales `e`, or a part of it that has its unit: in `sin(314*time)` it may
        well be a frequency, whose unit has no place to stand. A sign or a 1 is no scale; a constant without unit
        is (`m*g`), and time alone is as if it had one."""
        found = self._scaled.get(e)
        if found is None:
            found = self._scaled[e] = self._is_scaled(e)
        return found

    def _is_scaled(self, e: Expr) -> bool:
        if e.op in ("*", "/"):
            return any(self._is_scale(a) or (a.op != "time" and self.has_written_factor(a)) for a in e.args)
        if e.op in ("if", "smooth"):  # a condition, an order
            return any(map(self.has_written_factor, e.args[1:]))
        if tells_units(e):
            return self.has_written_factor(e.value)
        if (meant := meant_by(e)) is not None:
            return self.has_written_factor(meant)
        if e.op in ("annotated", "^") or (e.op == "call" and str(e.value) in ("sqrt", "abs")):
            return self.has_written_factor(e.args[0])
        inside = e.op in ("+", "-", "neg", "min", "max", "noEvent", "pre") and any(map(self.has_written_factor, e.args))
        return inside or e.op == "time"

    def _is_scale(self, e: Expr) -> bool:
        return (e.op == "const" and abs(e.value) != 1 and meant_by(e) is None) or (
            e.op == "var" and self._variable(e) == LITERAL
        )


def times(a: Finding, b: Finding) -> Finding:
    if isinstance(a, Unit) and isinstance(b, Unit):
        return a * b
    if UNKNOWN in (a, b):
        return UNKNOWN
    known = a if isinstance(a, Unit) else b
    return Unit(known.exponents, None, soft=known.soft) if isinstance(known, Unit) else LITERAL


def over(a: Finding, b: Finding) -> Finding:
    return times(a, b**-1 if isinstance(b, Unit) else b)


def of_variable(unit: str, kind: str, variability: str) -> Finding:
    """The unit a declaration claims: Integers are counts, constants without unit are literals."""
    if unit:
        return parse_unit(unit)
    if kind == INTEGER:
        return _COUNT
    return LITERAL if variability == "constant" else UNKNOWN
