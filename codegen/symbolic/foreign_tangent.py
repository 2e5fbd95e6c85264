"""Derivative of a function in external C, whose statements nobody sees: a central difference along the direction.

The step is the cube root of the spacing of doubles, of the size of the arguments: there the error of the difference
(its square) and that of rounding (the spacing over it) are alike (W. H. Press and others, Numerical Recipes, 3rd
edition, 5.7).
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

from lacuna.codegen import flat
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import REAL, ZERO, Expr, add, call, const, div, maximum, mul, sub, var

_STEP = 2.0 ** (-52 / 3)


def difference(f: flat.Function, companions: dict[str, str], name: str) -> flat.Function:
    """The function `name` that gives the directional derivatives of the results of `f`, then the results."""
    real = [n for n in f.inputs if f.types[n] == REAL]
    shapes = {n: f.shapes[n] for n in (*f.inputs, *f.outputs)}
    types = {n: f.types[n] for n in shapes}
    for n in list(shapes):
        shapes[companions[n]], types[companions[n]] = f.shapes[n], REAL
    for n in ("size", "speed", "step"):
        shapes[n], types[n] = (), REAL
    sides = {side: {n: f"{side} {n}" for n in f.outputs} for side in ("up", "down")}
    for names in sides.values():
        shapes |= {new: f.shapes[n] for n, new in names.items()}
        types |= {new: f.types[n] for n, new in names.items()}
    span, step = f.span, var("step")
    size = _largest(e for n in real for e in _elements(n, f.shapes[n]))
    speed = _largest(e for n in real for e in _elements(companions[n], f.shapes[n]))
    scale = ex.if_else(ex.relation(">", var("size"), ZERO), var("size"), ex.ONE)
    moved: list[flat.Statement] = [flat.Assign("step", div(mul(const(_STEP), scale), var("speed")), span)]
    for side, factor in (("up", step), ("down", ex.neg(step))):
        arguments = [_argument(n, f, companions[n] if n in real else None, factor) for n in f.inputs]
        moved.append(flat.AssignCall(tuple(sides[side].values()), call(f.name, *arguments), span))
    for n in (n for n in f.outputs if f.types[n] == REAL):
        pairs = zip(_elements(sides["up"][n], f.shapes[n]), _elements(sides["down"][n], f.shapes[n]), strict=True)
        slopes = [div(sub(up, down), mul(const(2.0), step)) for up, down in pairs]
        moved.append(flat.Assign(companions[n], ex.array(*slopes) if f.shapes[n] else slopes[0], span))
    body: list[flat.Statement] = [
        flat.Assign("size", size, span),
        flat.Assign("speed", speed, span),
        flat.If([(ex.relation(">", var("speed"), ZERO), moved)], span),
        flat.AssignCall(f.outputs, call(f.name, *(_argument(n, f, None, ZERO) for n in f.inputs)), span),
    ]
    inputs = f.inputs + tuple(companions[n] for n in f.inputs)
    outputs = tuple(companions[n] for n in f.outputs) + f.outputs
    return flat.Function(name, inputs, outputs, shapes, types, {}, body, span)


def _elements(name: str, shape: tuple[int, ...]) -> list[Expr]:
    if not shape:
        return [var(name)]
    every = product(*(range(1, n + 1) for n in shape))
    return [call("[]", var(name), *map(const, index)) for index in every]


def _largest(items: Iterable[Expr]) -> Expr:
    found: Expr = ZERO
    for item in items:
        found = maximum(found, call("abs", item))
    return found


def _argument(name: str, f: flat.Function, direction: str | None, factor: Expr) -> Expr:
    shape = f.shapes[name]
    if not shape and f.types[name] != REAL:
        return var(name, f.types[name])
    own = _elements(name, shape)
    if direction is not None:
        own = [add(a, mul(factor, d)) for a, d in zip(own, _elements(direction, shape), strict=True)]
    return ex.array(*own) if shape else own[0]
