"""Constants, evaluated parameters and final literals take their values; what equals an expression in parameters
becomes a dependent parameter, so that nothing constant is computed during integration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.structure.causal import Step, rewritten
from lacuna.codegen.structure.system import Row, System
from lacuna.codegen.symbolic.expr import BUILTINS, ONE, REAL, Expr, div, mul, to_text, transform, var, walk
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter


def evaluate_constants(model: flat.FlatModel) -> flat.FlatModel:
    """Replace every constant, evaluated parameter and final parameter that has a literal value by that value, and so
    every parameter that depends on such alone."""
    try:
        values = _literal_values(model)
    except Diagnostic:  # a circle that may not be there once structural parameters have their values (4.4.3)
        known = {n: v.binding for n, v in model.variables.items() if v.evaluated and _is_literal(v.binding)}
        model = Rewriter(lambda n: known.get(n.value) if n.op == "var" else None).model(model)
        values = _literal_values(model)
    model = Rewriter(lambda n: values.get(n.value) if n.op == "var" else None).model(model)
    fixed = {n: replace(v, evaluated=True) for n in values if not (v := model.variables[n]).final}
    return replace(model, variables=model.variables | fixed)


def _is_literal(e: Expr | None) -> bool:
    return e is not None and e.op == "const"


def _literal_values(model: flat.FlatModel) -> dict[str, Expr]:
    """By name. A parameter whose declared value is no literal cannot be set, so what it depends on decides it."""
    values: dict[str, Expr] = {}
    rewriter = Rewriter(lambda n: values.get(n.value) if n.op == "var" else None)
    for name in dependency_order(model):
        v = model.variables[name]
        if v.variability == flat.CONSTANT or v.evaluated or v.final or v.binding.op != "const":
            value = rewriter.expression(v.binding)
            if value.op == "const":
                values[name] = value
    return values


def dependency_order(model: flat.FlatModel) -> list[str]:
    """Names of constants and parameters with a binding, each after those that its binding uses; a cycle is refused."""
    order: dict[str, None] = {}
    path: dict[str, None] = {}

    def visit(name: str) -> None:
        v = model.variables[name]
        if name in order or v.binding is None or v.variability not in (flat.CONSTANT, flat.PARAMETER):
            return
        if name in path:
            names = list(path)
            cycle = names[names.index(name) :]
            notes = [(model.variables[n].span, f"{n} = {model.variables[n].binding}") for n in cycle[1:]]
            hint = "give one of these parameters a value of its own"
            raise Diagnostic("S001", f"parameter {name} depends on itself", v.span, hint, notes)
        path[name] = None
        for used in sorted(str(leaf.value) for leaf in leaves(v.binding) if leaf.op == "var"):
            visit(used)
        del path[name]
        order[name] = None

    for name in model.variables:
        visit(name)
    return list(order)


def is_parametric(e: Expr, variables: dict[str, flat.Variable]) -> bool:
    """Whether `e` depends on constants and parameters only."""
    return all(
        leaf.op == "var" and variables[str(leaf.value)].variability in (flat.CONSTANT, flat.PARAMETER)
        for leaf in leaves(e)
    )


def parametric_unknowns(model: flat.FlatModel, differentiated: set[str]) -> flat.FlatModel:
    """Continuous variables given by an expression in parameters become parameters with that binding."""
    while True:
        variables, equations = dict(model.variables), []
        for eq in model.equations:
            name, value = _definition(eq, variables, differentiated)
            if name is None:
                equations.append(eq)
            else:
                variables[name] = replace(variables[name], variability=flat.PARAMETER, binding=value, final=True)
        if len(equations) == len(model.equations):
            return model
        model = evaluate_constants(replace(model, variables=variables, equations=equations))


def _definition(
    eq: flat.Equation, variables: dict[str, flat.Variable], differentiated: set[str]
) -> tuple[str | None, Expr]:
    for unknown, value in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)):
        if unknown.op == "var":
            v = variables[str(unknown.value)]
            local = v.variability == flat.CONTINUOUS and v.causality != "input" and v.name not in differentiated
            if local and is_parametric(value, variables) and not any(n.op == "sample" for n in walk(value)):
                return v.name, value
    return None, eq.rhs


def precompute(system: System) -> System:
    """Costly subexpressions in parameters only become dependent parameters, computed once before a run."""
    model, names = system.model, dict(system.model.variables)

    def rule(n: Expr) -> Expr | None:
        if not n.args or n.op in ("der", "pre", "array") or n.type != REAL or not is_parametric(n, model.variables):
            return None
        operations = [part for part in walk(n) if part.op in ("call", "^", "/")]
        if not operations or any(part.op == "call" and part.value not in BUILTINS for part in operations):
            return None  # cheap, or a function of the model, which might fail where it is not wanted
        return _parameter(to_text(n), n, names, model.span)

    rewriter = Rewriter(rule)
    rows: dict[Row, Row] = {}
    for row in system.rows:
        integral = rows[row.integral] if row.integral else None
        rows[row] = Row(rewriter.expression(row.lhs), rewriter.expression(row.rhs), row.source, integral)
    return replace(system, rows=list(rows.values()), model=replace(model, variables=names))


def _parameter(name: str, value: Expr, names: dict[str, flat.Variable], span: Span) -> Expr:
    """The dependent parameter of that value, called `name` where nothing else is: long texts are cut, and alike."""
    while name in names and names[name].binding is not value:
        name += "'"
    names.setdefault(name, flat.Variable(name, span, variability=flat.PARAMETER, binding=value, final=True))
    return var(name)


def precompute_inverses(steps: Sequence[Step], system: System) -> tuple[list[Step], System]:
    """Divisions by parameters as products with dependent parameters: the right-hand side is a chain of operations of
    which a division takes as long as all others together."""
    model, names = system.model, dict(system.model.variables)
    memo: dict[Expr, Expr] = {}

    def inverse(e: Expr) -> Expr | None:
        if e.op != "/" or e.args[1].op == "const" or not is_parametric(e.args[1], model.variables):
            return None
        divisor = e.args[1]
        factor = _parameter(f"inverse of {to_text(divisor)}", div(ONE, divisor), names, model.span)
        return mul(transform(e.args[0], inverse, memo), factor)

    changed = [rewritten(step, lambda e: transform(e, inverse, memo)) for step in steps]
    return changed, replace(system, model=replace(model, variables=names))
