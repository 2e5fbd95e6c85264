"""Algorithm sections of models: with `when` they stay statements; without, symbolic execution makes equations."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.classes.types import Type
from lacuna.codegen.flatten.equations.equations import Collected, check_target, check_types, origin_of, pairs, unroll
from lacuna.codegen.flatten.equations.independent import independent_parts
from lacuna.codegen.flatten.equations.mixed import lasting_targets, split_by_time
from lacuna.codegen.flatten.equations.symbolic_run import SymbolicRun
from lacuna.codegen.flatten.equations.when import procedure, refuse_inner_whens, when_conditions
from lacuna.codegen.flatten.expressions.constants import is_known, known
from lacuna.codegen.flatten.expressions.lower import NOT_THERE, lower, lower_results, lower_scalar
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import shape_of, shape_text
from lacuna.codegen.flatten.references.iterators import varying_bounds
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, INTEGER, TRUE, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import assigned
from lacuna.codegen.syntax import ast


def flatten_algorithm(section: ast.Section, scope: Scope, out: Collected) -> None:
    """Add what an algorithm section computes, as Algorithms or as equations."""
    refuse_inner_whens(section.items)
    statements = _statements(section.items, scope, in_when=False)
    parts = independent_parts(statements, scope.context) if _has_when(statements) else [statements]
    for part in parts:
        _flatten_part(part, section, scope, out)


def _has_when(statements: list[flat.Statement]) -> bool:
    return any(isinstance(s, flat.When) for s in _nested(statements))


def _flatten_part(statements: list[flat.Statement], section: ast.Section, scope: Scope, out: Collected) -> None:
    context, names = scope.context, assigned(statements)
    if _has_when(statements):
        lasting = lasting_targets(statements, context)
        targets = _with_whole_arrays([n for n in names if n in lasting], context)
        run = SymbolicRun(scope, targets)
        kept = split_by_time(statements, lasting, run)
        others = _with_whole_arrays([n for n in names if n not in lasting], context)
        out.algorithms.append(flat.Algorithm(kept, others, section.span, origin_of(scope)))
    else:
        targets = tuple(names) if section.initial else _with_whole_arrays(names, context)
        run = SymbolicRun(scope, targets)
        run.block(statements, TRUE)
    carried = context.table(Carried)
    for target in targets:
        if carried.pop(target, ""):
            continue  # what it carried is where it belongs
        value = run.result(target) if target in run.values else run.unassigned(target)
        variable, span = ex.var(target, run.type_of(target)), run.where.get(target, section.span)
        out.equations.append(flat.Equation(variable, value, span, origin_of(scope), f"{target} := ..."))
    out.asserts += run.asserts


def _with_whole_arrays(names: Iterable[str], context: Context) -> tuple[str, ...]:
    """An algorithm that assigns elements of an array gives the whole of it: the others keep what they start with
    (11.1.2)."""
    given = list(names)
    leaves = {id(leaf): leaf for leaf, _ in (context.scalars[name] for name in given)}.values()
    return tuple(dict.fromkeys([*given, *(n for leaf in leaves for n in leaf.names)]))


def _nested(statements: list[flat.Statement]) -> list[flat.Statement]:
    bodies = [body for s in statements if isinstance(s, flat.If) for _, body in s.branches]
    bodies += [s.body for s in statements if isinstance(s, flat.While)]
    return [*statements, *(n for body in bodies for n in _nested(body))]


def _is_left(statements: list[flat.Statement]) -> bool:
    return bool(statements) and isinstance(statements[-1], flat.Break)


def _statements(items: list[ast.Item], scope: Scope, in_when: bool) -> list[flat.Statement]:
    result: list[flat.Statement] = []
    for item in items:
        if _is_left(result):
            break  # in each case: what follows never runs
        if isinstance(item, ast.Assignment):
            result += assignment(item, scope)
        elif isinstance(item, ast.If):
            result += _if(item, scope, in_when)
        elif isinstance(item, ast.For):
            result += _for(item, scope, in_when)
        elif isinstance(item, ast.While):
            condition = lower_scalar(item.condition, scope, BOOLEAN)
            result.append(flat.While(condition, _statements(item.body, scope, in_when), item.span))
        elif isinstance(item, ast.Break):
            result.append(flat.Break(item.span))
        elif isinstance(item, ast.When):
            result.append(_when(item, scope, in_when))
        elif isinstance(item, ast.Procedure):
            result += _procedure(item, scope, in_when)
        else:
            what = type(item).__name__.lower()
            hint = "put the loop in a function and call it"
            raise Diagnostic("R059", f"'{what}' in the algorithm of a model", item.span, hint)
    return result


def _for(item: ast.For, scope: Scope, in_when: bool) -> list[flat.Statement]:
    """Pass by pass; inside of when a range that varies is counted through. Loops of several variables are nested."""
    if len(item.iterators) > 1:
        first, *rest = item.iterators
        item = ast.For(item.span, [first], [ast.For(item.span, rest, item.body)])
    if in_when and (varying := varying_bounds(item.iterators[0], scope)) is not None:
        return _counted(item, *varying, scope)
    whole: list[flat.Statement] = []
    for inner in unroll(item, scope):
        if not _is_left(whole):
            whole += _statements(item.body, inner, in_when)
    left = any(isinstance(s, flat.Break) for s in _nested(whole))
    return [flat.While(TRUE, [*whole, flat.Break(item.span)], item.span)] if left else whole


def _counted(item: ast.For, first: Expr, step: Expr, last: Expr, scope: Scope) -> list[flat.Statement]:
    """The loop with a counter: where it ends is settled when it begins (11.2.2)."""
    name, span = item.iterators[0].name, item.span
    counter, end = (_counter(f"{what}{name}", item, scope) for what in ("", "end of "))
    body = _statements(item.body, scope.with_locals(**{name: counter}), in_when=True)
    going = ex.relation("<=" if step.value > 0 else ">=", counter, end)
    on = flat.Assign(str(counter.value), ex.add(counter, step), span)
    begin = [flat.Assign(str(v.value), value, span) for v, value in ((counter, first), (end, last))]
    return [*begin, flat.While(going, [*body, on], span)]


def _counter(name: str, item: ast.For, scope: Scope) -> Expr:
    """A variable of the generator's own."""
    carried = scope.context.table(Carried)
    name = f"new {name} {len(carried) + 1}"
    carried[name] = ""
    kind = ast.Ref(item.span, (INTEGER,), (None,))
    declared = ast.Component(item.span, name, kind, [], ast.Modification(item.span), protected=True)
    Leaf(scope.context, scope.instance, declared, name, Type(INTEGER), (), Modifier(item.span))
    return ex.var(name, INTEGER)


def _procedure(item: ast.Procedure, scope: Scope, in_when: bool) -> list[flat.Statement]:
    if str(item.call.function) == "reinit":
        raise Diagnostic("R056", "reinit in an algorithm", item.span, "write it in a when-equation (8.3.6)")
    if not in_when and str(item.call.function) == "terminate":
        hint = f"put it under a condition: when ... then {item.call.function}(...); end when;"
        raise Diagnostic("R056", f"{item.call.function} outside of when", item.span, hint)
    return procedure(item, scope)


def _when(item: ast.When, scope: Scope, in_when: bool) -> flat.When:
    if in_when:
        raise Diagnostic("R057", "'when' inside of when", item.span, "combine the conditions: when a and b then")
    branches = []
    for written, body in item.branches:
        statements = _statements(body, replace(scope, pure=False), in_when=True)
        branches += [(condition, statements) for condition in when_conditions(written, scope)]
    return flat.When(branches, item.span, origin_of(scope))


def _if(item: ast.If, scope: Scope, in_when: bool) -> list[flat.Statement]:
    branches = []
    for written, body in item.branches:
        condition = TRUE if written is None else lower_scalar(written, scope, BOOLEAN)
        if condition is FALSE:
            continue
        if condition is not TRUE:
            scope = replace(scope, conditional=True)
        try:
            branches.append((condition, _statements(body, scope, in_when)))
        except Diagnostic as error:
            if error.code not in NOT_THERE or not _never(condition, branches, scope, item.span):
                raise
        if condition is TRUE:
            break
    if branches and branches[0][0] is TRUE:
        return branches[0][1]
    return [flat.If(branches, item.span)] if branches else []


def _never(condition: Expr, before: list[tuple[Expr, list[flat.Statement]]], scope: Scope, span: Span) -> bool:
    """Is it known at translation that a branch is not taken: its condition fails, or one before it holds?"""
    decided = [known(c, scope, span, "the condition") is TRUE for c, _ in before if is_known(c, scope.context)]
    return any(decided) or (
        is_known(condition, scope.context) and known(condition, scope, span, "the condition") is FALSE
    )


def assignment(item: ast.Assignment, scope: Scope) -> list[flat.Statement]:
    """target := value, scalar by scalar; values are read before any is assigned."""
    if isinstance(item.target, ast.Tuple):
        values = lower_results(item.value, scope, len(item.target.items))
        sides = [(lower(t, scope), v) for t, v in zip(item.target.items, values, strict=False) if t is not None]
    else:
        sides = [(lower(item.target, scope), lower(item.value, scope))]
    found: dict[Expr | str, flat.Assign] = {}
    written: list[Expr | str] = []
    for target, value in sides:
        if shape_of(target) != shape_of(value):
            message = f"{shape_text(shape_of(target))} := {shape_text(shape_of(value))}"
            raise Diagnostic("R042", f"the sides differ in size: {message}", item.span, "both need the same size")
        for t, v in pairs(target, value, item.span, scope):
            written.append(t)
            for chosen, new in _chosen(t, v, found):
                check_target(chosen, item.span, scope)
                check_types(chosen, v, item.span, scope)
                found[chosen] = flat.Assign(str(chosen.value), new, item.span)
    result = list(found.values())
    if len(result) > 1 and (len(written) > 1 or _chosen_by_itself(written[0])):
        result = _simultaneous(result, scope.context)
    return result


def _chosen_by_itself(target: Expr | str) -> bool:
    """Whether elements of an array decide which of them is meant. Otherwise all but one stay what they are, and the
    value of that one may be read from any."""
    choices = _choices(target, TRUE) if isinstance(target, Expr) else {}
    return not choices.keys().isdisjoint(leaf for condition in choices.values() for leaf in leaves(condition))


def _choices(target: Expr, condition: Expr) -> dict[Expr, Expr]:
    """The elements that a target by subscripts that vary may mean, and when it does."""
    if target.op != "if":
        return {target: condition}
    first, here, there = target.args
    found = _choices(here, ex.logical_and(condition, first))
    for element, when in _choices(there, ex.logical_and(condition, ex.logical_not(first))).items():
        found[element] = ex.logical_or(found[element], when) if element in found else when
    return found


def _chosen(
    target: Expr | str, value: Expr | str, found: dict[Expr | str, flat.Assign]
) -> list[tuple[Expr | str, Expr | str]]:
    """An element by a subscript that varies is a choice among all of them: the one chosen is set, the others stay what
    they are or, by the same assignment, are `found` to be; a subscript of none of them leaves no number."""

    def stays(e: Expr) -> Expr:
        return found[e].value if e in found else e

    if not isinstance(target, Expr) or target.op != "if" or not isinstance(value, Expr):
        return [(target, value)]
    choices = _choices(target, TRUE)
    outside = {e: when for e, when in choices.items() if ex.is_nothing(e)}
    others = {e: stays(e) for e in choices if e not in outside}
    for nothing, when in outside.items():
        others = {e: ex.if_else(when, nothing, rest) for e, rest in others.items()}
    return [(e, ex.if_else(choices[e], value, rest)) for e, rest in others.items()]


class Carried(dict[str, str]):
    """Variables that carry values to elements which are assigned together, and the elements; counters have ""."""


def carriers(model: flat.FlatModel, context: Context) -> dict[str, flat.Variable]:
    """The variables that carry values at events, each like the element that it is for."""
    plain = {"causality": "local", "fixed": None, "hidden": True}
    found: dict[str, flat.Variable] = {}
    for n, e in context.table(Carried).items():
        counter = flat.Variable(n, context.scalars[n][0].span, INTEGER, flat.DISCRETE)
        found[n] = replace(model.variables[e] if e else counter, name=n, description=f"assigned to {e}", **plain)
    return found


def _simultaneous(result: list[flat.Assign], context: Context) -> list[flat.Assign]:
    """Elements assigned together do not read each other's new values (11.2.1.1): what another one reads later gets its
    own at the end."""
    read: set[str] = set()
    late: set[str] = set()
    for s in reversed(result):
        if s.target in read:
            late.add(s.target)
        read |= {str(n.value) for n in leaves(s.value) if n.op == "var"}
    first, last = [], []
    for s in result:
        if s.target not in late:
            first.append(s)
            continue
        name = f"new {s.target}"
        context.scalars[name] = context.scalars[s.target]
        context.table(Carried)[name] = s.target
        first.append(replace(s, target=name))
        last.append(flat.Assign(s.target, ex.var(name, context.scalars[name][0].primitive), s.span))
    return first + last
