"""pre, edge and change of the model's own discrete inputs: the value that an input had before the event (3.7.5).

Who drives an input sets it, so nothing of the model keeps what it was. A discrete variable does, which follows it:

    held(u) = u        pre(u) is pre(held(u)), edge(u) is u and not pre(held(u)), change(u) is u <> pre(held(u))
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr, walk
from lacuna.codegen.symbolic.rewrite import Rewriter, expressions

_ASKING = ("pre", "edge", "change")


def hold_inputs(model: flat.FlatModel) -> flat.FlatModel:
    """The model with a variable for each discrete input of which `pre`, `edge` or `change` asks; itself where none."""
    inputs = {n for n, v in model.variables.items() if v.causality == "input" and v.variability == flat.DISCRETE}
    asked = {str(n.args[0].value) for n in _asking(model) if n.args[0].op == "var"} & inputs if inputs else set()
    if not asked:
        return model
    held = {name: ex.var(f"held({name})", model.variables[name].type) for name in inputs if name in asked}

    def rule(n: Expr) -> Expr | None:
        name = str(n.args[0].value) if n.op in _ASKING and n.args[0].op == "var" else ""
        if name not in held:
            return None
        now, before = n.args[0], ex.pre(held[name])
        if n.op == "pre":
            return before
        if n.op == "edge":
            return ex.logical_and(now, ex.logical_not(before))
        return ex.relation("<>", now, before)

    model = Rewriter(rule).model(model)
    variables, equations = dict(model.variables), list(model.equations)
    for name in (n for n in model.variables if n in held):
        v, what = variables[name], held[name]
        text = f"the input {name} before an event"
        variables[str(what.value)] = replace(v, name=str(what.value), causality="local", description=text)
        same = ex.special("noEvent", ex.var(name, v.type), type=v.type)  # no alias: it stays while the input moves
        equations.append(flat.Equation(what, same, v.span, "", f"held({name}) = {name}"))
    return replace(model, variables=variables, equations=equations)


def _asking(model: flat.FlatModel) -> Iterator[Expr]:
    parts = [side for e in (*model.equations, *model.initial_equations) for side in (e.lhs, e.rhs)]
    parts += [e for w in model.whens for e in expressions([w])]
    parts += [e for a in model.algorithms for e in expressions(a.statements)]
    parts += [e for a in model.asserts for e in expressions([a])]
    return (n for e in parts for n in walk(e) if n.op in _ASKING)
