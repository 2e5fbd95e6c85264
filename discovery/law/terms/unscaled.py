"""A term of a law as it is said to readers: the sizes by which its variables are made dimensionless multiplied out."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
import math
import re

_SAID = {"dry": "sign", "onset": "delay", "warmth": "lag"}  # that differ in how they are simulated, or begin
_LINEAR = ("lag", "warmth", "delay", "onset", "swing")  # in their first argument
_ACCUMULATED = ("total", "spent")
_X = r"(?P<x>\((?:[^()]|\([^()]*\))*\))"  # what is made dimensionless
_PLAINER = (  # what is smooth for a fit, as it is thought of: (of a term, as it is said)
    (rf"abs\({_X} - (?P<q>\w+)\) \+ (?P=x) - (?P=q)", r"2*max(0, \g<x> - \g<q>)"),
    (rf"abs\(-{_X} - (?P<q>\w+)\) - (?P=x) - (?P=q)", r"2*max(0, -\g<x> - \g<q>)"),
    (rf"{_X} \+ (?P<q>\w+) - abs\((?P=x) - (?P=q)\)", r"2*min(\g<x>, \g<q>)"),
    (
        rf"{_X} - 0\.5\*abs\((?P=x) \+ (?P<q>\w+)\) \+ 0\.5\*abs\((?P=x) - (?P=q)\)",
        r"\g<x> - max(-\g<q>, min(\g<x>, \g<q>))",
    ),
    (rf"abs\({_X} \+ (?P<q>\w+)\) - abs\((?P=x) - (?P=q)\)", r"2*max(-\g<q>, min(\g<x>, \g<q>))"),
)


@dataclass(frozen=True)
class _Scaled:
    """`factor` times an expression; a number where there is none."""

    factor: float
    of: ast.expr | None = None

    @property
    def sign(self) -> float:
        return math.copysign(1.0, self.factor)

    def node(self) -> ast.expr:
        """As it is said, the number in front."""
        return _number(self.factor) if self.of is None else _times(self.factor, self.of)


def unscaled(text: str, values: Mapping[str, float]) -> str:
    """A term in the names of its component, with the numbers that some of them stand for in place of these."""
    for of_term, plainer in _PLAINER:
        text = re.sub(of_term, plainer, text)
    said = ast.unparse(_read(ast.parse(text.replace("^", "**"), mode="eval").body, values).node())
    return re.sub(r" (\*\*?|/) ", lambda found: found[1].replace("**", "^"), said)


def _read(node: ast.expr, values: Mapping[str, float]) -> _Scaled:
    match node:
        case ast.Constant(value=value):
            return _Scaled(float(value))
        case ast.Name(id=name) if name in values:
            return _Scaled(values[name])
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            found = _read(operand, values)
            return replace(found, factor=-found.factor)
        case ast.BinOp(left=left, op=op, right=right):
            return _combined(_read(left, values), op, _read(right, values))
        case ast.Call(func=ast.Name(id=name), args=arguments):
            return _called(name, [_read(a, values) for a in arguments])
    return _Scaled(1.0, node)


def _combined(a: _Scaled, op: ast.operator, b: _Scaled) -> _Scaled:
    match op:
        case ast.Mult():
            return _Scaled(a.factor * b.factor, (a.of and b.of and ast.BinOp(a.of, op, b.of)) or a.of or b.of)
        case ast.Div():
            return _Scaled(a.factor / b.factor, ast.BinOp(a.of or _number(1.0), op, b.of) if b.of else a.of)
        case ast.Pow():
            return _power(a, b)
    return _added(a, b if isinstance(op, ast.Add) else replace(b, factor=-b.factor))


def _power(a: _Scaled, b: _Scaled) -> _Scaled:
    """A power, of which the number is taken out where it is one of a positive number to a known exponent."""
    power = ast.Name(f"({b.factor:.4g})") if b.of is None and b.factor < 0 else b.node()
    if b.of is None and a.factor > 0:
        return _Scaled(a.factor**b.factor, a.of and ast.BinOp(a.of, ast.Pow(), power))
    return _Scaled(1.0, ast.BinOp(a.node(), ast.Pow(), power))


def _added(a: _Scaled, b: _Scaled) -> _Scaled:
    """A sum, of which the number is taken out that the terms have in common; what is added to one stays as it is."""
    if a.of is None and b.of is None:
        return _Scaled(a.factor + b.factor)
    share = 1.0 if any(p.of is None and abs(p.factor) == 1.0 for p in (a, b)) else _common((a, b))
    first, second = (_part(p, share) for p in (a, b))
    minus = b.factor < 0
    return _Scaled(
        share, ast.BinOp(first, ast.Sub() if minus else ast.Add(), _without_sign(second) if minus else second)
    )


def _called(name: str, arguments: list[_Scaled]) -> _Scaled:
    first, *rest = arguments
    if first.of is not None and name == "abs":
        return _Scaled(abs(first.factor), _call(name, first.of))
    if first.of is not None and name in ("sign", "dry"):
        return _Scaled(first.sign, _call(name, first.of))
    if first.of is not None and name in _LINEAR:
        kept = rest[:1] if name in ("delay", "onset") else rest  # how far apart it is kept is of no interest
        return _Scaled(first.factor, _call(name, first.of, *(p.node() for p in kept)))
    if name in _ACCUMULATED or (name == "warmth" and first.of is None):
        return _accumulated(name, first, rest[0])
    if first.of is not None and name == "hysteresis":  # what is dragged along, and on which way it is bent
        return _Scaled(first.sign, _call(name, first.of, _number(rest[0].factor / abs(first.factor))))
    if name in ("max", "min"):
        share = _common(arguments)
        return _Scaled(share, _call(name, *(_part(p, share) for p in arguments)))
    return _Scaled(1.0, _call(name, *(p.node() for p in arguments)))


def _accumulated(name: str, first: _Scaled, time: _Scaled) -> _Scaled:
    """What has come together since the start; of nothing but time, the time since then."""
    done = ast.Name("elapsed") if first.of is None else _call("integral", first.of)
    if name == "total":
        return _Scaled(first.factor / time.factor, done)
    gone = ast.UnaryOp(ast.USub(), ast.BinOp(done, ast.Div(), _number(time.factor / first.factor)))
    return _Scaled(1.0, ast.BinOp(_number(1.0), ast.Sub(), _call("exp", gone)))


def _common(parts: Sequence[_Scaled]) -> float:
    """The size of the number before all parts that are none themselves; 1 where they differ."""
    sizes = sorted({abs(p.factor) for p in parts if p.of is not None} - {0.0})
    return sizes[0] if sizes and math.isclose(sizes[0], sizes[-1]) else 1.0


def _part(part: _Scaled, share: float) -> ast.expr:
    """A part over what is taken out; a number that is compared with others has a digit more than one that scales."""
    if part.of is not None:
        return replace(part, factor=part.sign if math.isclose(abs(part.factor), share) else part.factor / share).node()
    return _number(part.factor / share, 5)


def _times(factor: float, of: ast.expr) -> ast.expr:
    if factor == 1.0:
        return of
    if isinstance(of, ast.BinOp) and isinstance(of.op, ast.Mult | ast.Div):
        return ast.BinOp(_times(factor, of.left), of.op, of.right)
    if isinstance(of, ast.Name) and of.id == "1":
        return _number(factor)
    return ast.UnaryOp(ast.USub(), of) if factor == -1.0 else ast.BinOp(_number(factor), ast.Mult(), of)


def _number(value: float, digits: int = 4) -> ast.expr:
    number = ast.Name(f"{abs(value):.{digits}g}")
    return ast.UnaryOp(ast.USub(), number) if value < 0 else number


def _without_sign(node: ast.expr) -> ast.expr:
    """What a negative term takes away: its number, in front, is negative."""
    if isinstance(node, ast.BinOp):
        return ast.BinOp(_without_sign(node.left), node.op, node.right)
    return node.operand if isinstance(node, ast.UnaryOp) else node


def _call(name: str, *arguments: ast.expr) -> ast.expr:
    return ast.Call(ast.Name(_SAID.get(name, name)), list(arguments), [])
