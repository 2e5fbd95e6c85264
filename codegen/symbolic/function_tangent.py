"""Derivative of a function of the model: its statements differentiated forward, one by one.

The tangent of y = f(a) is a function f:tangent(a, a:d1) of the inputs and their derivatives, with results (y:d1, y):
every local gets a companion that is assigned just before it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.flat.foreign import Foreign
from lacuna.codegen.symbolic.differentiate import TANGENT, Differentiator
from lacuna.codegen.symbolic.expr import REAL, ZERO, Expr, node, var
from lacuna.codegen.symbolic.foreign_tangent import difference


def _companion(name: str, f: flat.Function) -> str:
    """The name of the derivative of a local; every order of differentiation has names of its own."""
    return f"{name}:d{f.name.count(TANGENT) + 1}"


def tangent(f: flat.Function) -> flat.Function:
    """The function that gives the directional derivatives of the results of `f`, then the results."""
    companions = {n: _companion(n, f) for n in f.shapes if _has_companion(n, f)}
    if any(isinstance(s, Foreign) for s in f.body):
        return difference(f, companions, f.name + TANGENT)
    differentiate = Differentiator(lambda n: _seed(n, f))
    return flat.Function(
        f.name + TANGENT,
        f.inputs + tuple(companions[n] for n in f.inputs),
        tuple(companions[n] for n in f.outputs) + f.outputs,
        {**f.shapes, **{d: f.shapes[n] for n, d in companions.items()}},
        {**f.types, **dict.fromkeys(companions.values(), REAL)},
        {**{companions[n]: differentiate(e) for n, e in f.defaults.items() if n in companions}, **f.defaults},
        _statements(f.body, f, differentiate),
        f.span,
    )


def _has_companion(name: str, f: flat.Function) -> bool:
    """Arguments and results have one whatever their type, so that positions agree; other locals where they are Real."""
    return f.types[name] == REAL or name in f.inputs or name in f.outputs


def _seed(n: Expr, f: flat.Function) -> Expr:
    name = str(n.value)
    return var(_companion(name, f)) if n.op == "var" and f.types.get(name) == REAL else ZERO


def _statements(body: Iterable[flat.Statement], f: flat.Function, d: Differentiator) -> list[flat.Statement]:
    return [s for statement in body for s in _statement(statement, f, d)]


def _statement(s: flat.Statement, f: flat.Function, d: Differentiator) -> list[flat.Statement]:
    match s:
        case flat.Assign() | flat.AssignElement():
            if not _has_companion(s.target, f):
                return [s]
            derivative = d(s.value) if f.types[s.target] == REAL else ZERO
            return [replace(s, target=_companion(s.target, f), value=derivative), s]
        case flat.AssignCall():
            tangents = tuple(None if t is None or not _has_companion(t, f) else _companion(t, f) for t in s.targets)
            arguments = s.value.args + tuple(map(d, s.value.args))
            inner = node("call", arguments, f"{s.value.value}{TANGENT}", REAL)
            return [replace(s, targets=tangents + s.targets, value=inner)]
        case flat.If():
            return [replace(s, branches=[(c, _statements(b, f, d)) for c, b in s.branches])]
        case flat.While() | flat.For():
            return [replace(s, body=_statements(s.body, f, d))]
    return [s]


def by_name(functions: dict[str, flat.Function], name: str) -> flat.Function:
    """A function of the model, or the tangent (of a tangent ...) of one."""
    if name in functions:
        return functions[name]
    return tangent(by_name(functions, name.removesuffix(TANGENT)))


def original(functions: dict[str, flat.Function], name: str) -> flat.Function:
    """The function of the model that this is the tangent (of a tangent ...) of, or itself."""
    return functions[name] if name in functions else original(functions, name.removesuffix(TANGENT))
