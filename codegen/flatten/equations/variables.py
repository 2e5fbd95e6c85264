"""Declared variables to flat variables with their attributes; bindings of unknowns to equations."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.classes.types import EXTERNAL
from lacuna.codegen.flatten.equations.equations import real_or_same
from lacuna.codegen.flatten.expressions.constants import evaluate, is_parameter, variability
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of, require_same
from lacuna.codegen.flatten.names.annotations import warn_of_slips
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import Record, items_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.syntax import ast

_STATE_SELECT = ("never", "avoid", "default", "prefer", "always")
_NUMERIC = ("start", "min", "max", "nominal")


def flatten_variables(leaf: Leaf, model: flat.FlatModel) -> None:
    """Add the scalars of one declaration to `model`, and its binding where it is not a parameter."""
    if leaf.primitive in ("String", EXTERNAL):
        _check_text(leaf)
        return
    context = leaf.instance.context
    values = {name: leaf.attribute(name) for name in leaf.modifier.children}
    binding = leaf.binding()
    warn_of_slips(leaf.declaration.annotation, ["Evaluate"], context)
    for position, name in enumerate(leaf.names):
        _note_places(leaf, name)
        attributes = {k: leaf.element(v, position) for k, v in values.items() if v is not None}
        variable = _variable(leaf, position, attributes)
        value = leaf.element(binding, position)
        if leaf.is_structural:
            variable.binding = _parameter_value(leaf, variable, value, context)
            _refuse_circle(leaf, variable.binding)
        elif value is not None:
            span = leaf.modifier.span
            checked = _typed(value, leaf, name, span)
            v = ex.var(name, leaf.primitive)
            text = f"{name} = {ex.to_text(checked)}"
            model.equations.append(flat.Equation(v, checked, leaf.span, leaf.instance.name, text))
        model.variables[name] = variable


def _refuse_circle(leaf: Leaf, binding: Expr | None) -> None:
    """A parameter's value does not depend on itself, be it on another element of it (4.4.3)."""
    own = () if binding is None or len(leaf.names) == 1 else leaves(binding)
    if any(n.op == "var" and n.value in leaf.names for n in own):
        raise Diagnostic("F022", f"the value of {leaf.name} depends on itself", leaf.span, "break the circle")


def _check_text(leaf: Leaf) -> None:
    """A String or an external object is no variable of the run, yet what it is bound to means something; whether the
    value of a String can be had matters where it is used (codes F, R091, R094). Raises R020 where it is no text."""
    try:
        found = leaf.binding()
    except Diagnostic as error:
        made = leaf.primitive == EXTERNAL  # it is made whether it is used or not
        if error.code[0] == "F" or (error.code in ("R091", "R094") and not made):
            return
        raise
    for item in () if found is None else items_of(found):
        if isinstance(item, Expr | Record):
            what = "a record" if isinstance(item, Record) else item.type
            raise Diagnostic("R020", f"the String {leaf.name} is bound to {what}", leaf.modifier.span, "String(x)")


def _note_places(leaf: Leaf, name: str) -> None:
    places = leaf.instance.context.places
    if leaf.modifier.value is not None:
        places[name, "binding"] = leaf.modifier.span
    for key, child in leaf.modifier.children.items():
        places[name, key] = child.span


def _is_hidden(leaf: Leaf) -> bool:
    declaration, owner = leaf.declaration, leaf.instance
    while owner is not None and owner.name and declaration is not None:
        if declaration.protected:
            return True
        declaration, owner = owner.declaration, owner.parent
    return False


def _variable(leaf: Leaf, position: int, attributes: dict[str, Expr | str]) -> flat.Variable:
    context, span, name = leaf.instance.context, leaf.span, leaf.names[position]
    result = flat.Variable(
        name,
        span,
        leaf.primitive,
        leaf.variability,
        description=leaf.declaration.description,
        fixed=leaf.fixed[position],
        final=leaf.modifier.final,
        evaluated=leaf.is_structural and _is_evaluated(leaf.declaration.annotation) and not leaf.is_free,
        awaited=bool(leaf.instance.name) and leaf.causality == "input" and leaf.modifier.value is None,
        hidden=_is_hidden(leaf),
    )
    for key in _NUMERIC:
        if key in attributes:
            value = _typed(attributes[key], leaf, f"{key} of {name}", leaf.modifier.children[key].span)
            if not is_parameter(value, context):
                hint = "use parameters and constants"
                raise Diagnostic("R055", f"{key} of {name} varies in time", leaf.modifier.children[key].span, hint)
            setattr(result, key, value)
    if "start" in attributes:
        result.start_at = leaf.modifier.children["start"].span
    for key in ("unit", "quantity", "displayUnit"):
        if key in attributes:
            text = _text(attributes[key], key, leaf)
            if key != "displayUnit":  # which is for a user's eyes
                setattr(result, key, text)
    if "unbounded" in attributes:
        _check_unbounded(leaf, _of_type(attributes["unbounded"], BOOLEAN, f"unbounded of {name}", span))
    if "stateSelect" in attributes:
        result.state_select = _state_select(attributes["stateSelect"], leaf)
    result.enumeration = leaf.type.literals
    given_here = leaf.causality == "input" and leaf.modifier.value is not None
    outside = leaf.instance.parent is None and leaf.instance.name == "" and not leaf.declaration.protected
    if outside and leaf.causality and not given_here:
        result.causality = leaf.causality
    return result


def _check_unbounded(leaf: Leaf, value: Expr) -> None:
    """A variable with unbounded = true is to be exact in absolute terms (4.9.6): solvers here bound its relative error,
    too, and a warning says so."""
    context, place = leaf.instance.context, leaf.modifier.children["unbounded"].span
    if evaluate(value, context, place, f"unbounded of {leaf.name}").value:
        message = f"{leaf.name} is unbounded: its error grows with it, as that of all variables"
        context.warnings.append(Diagnostic("W010", message, place, "lower the relative tolerance", severity="warning"))


def _is_evaluated(annotation: ast.Modification | None) -> bool:
    """annotation(Evaluate = true): the value is part of the structure (Modelica 3.6, 18.3)."""
    return any(
        a.name == "Evaluate" and isinstance(a.modification.value, ast.Literal) and a.modification.value.value is True
        for a in (annotation.arguments if annotation else ())
    )


def _state_select(value: Expr | str, leaf: Leaf) -> str:
    context, span = leaf.instance.context, leaf.modifier.children["stateSelect"].span
    if isinstance(value, str) or enumeration_of(value, context) != "StateSelect":
        hint = "StateSelect.prefer and the like"
        raise Diagnostic("R020", f"stateSelect of {leaf.name} is no StateSelect", span, hint)
    return _STATE_SELECT[int(evaluate(value, context, span, "stateSelect").value) - 1]


def _text(value: Expr | str, key: str, leaf: Leaf) -> str:
    if not isinstance(value, str):
        hint = f'{key} = "..."'
        raise Diagnostic("R020", f"{key} of {leaf.name} is not a String", leaf.modifier.children[key].span, hint)
    return value


def _typed(value: Expr | str, leaf: Leaf, what: str, span: Span) -> Expr:
    """`value` for the variable `leaf`; a whole number becomes a Real constant where that is needed."""
    kind = leaf.primitive
    checked = _of_type(value, kind, what, span)
    require_same(ex.var(leaf.names[0], kind), value, leaf.instance.context, span)
    return checked


def _of_type(value: Expr | str, kind: str, what: str, span: Span) -> Expr:
    if isinstance(value, str) or not real_or_same(kind, value):
        found = "String" if isinstance(value, str) else value.type
        hint = "integer(x) gives the whole number at or below x" if (kind, found) == (INTEGER, REAL) else ""
        raise Diagnostic("R024", f"{what} is {kind}, its value {found}", span, hint or f"give it a {kind}")
    whole = kind == REAL and value.op == "const" and value.type == INTEGER
    return ex.const(float(value.value)) if whole else value


def _parameter_value(leaf: Leaf, variable: flat.Variable, value: Expr | None, context: Context) -> Expr | None:
    span = leaf.modifier.span if leaf.modifier.value is not None else leaf.span
    if value is not None:
        checked = _typed(value, leaf, variable.name, span)
        if not is_parameter(checked, context):
            message = f"the {leaf.variability} {variable.name} depends on what varies: {ex.to_text(checked)}"
            raise Diagnostic("R055", message, span, "remove 'parameter', or use parameters and constants only")
        if leaf.variability == "constant" and variability(checked, context) != "constant":
            message = f"the constant {variable.name} depends on parameters: {ex.to_text(checked)}"
            raise Diagnostic("R055", message, span, "declare it as a parameter, or use constants only")
        if variable.fixed is ex.FALSE:
            variable.fixed = None
            message = f"{variable.name} has fixed = false and a value: it has that value (8.6)"
            hint = "drop the value where initial equations are to determine it, or else fixed = false"
            context.warnings.append(Diagnostic("W012", message, span, hint, severity="warning"))
        return checked
    if variable.fixed is ex.FALSE:
        return None
    if variable.start is not None and leaf.variability == "parameter":
        hint = f"give it a value: {variable.name} = ..."
        message = f"{variable.name} has no value; its start value is used"
        context.warnings.append(Diagnostic("W001", message, leaf.span, hint, severity="warning"))
        return variable.start
    hint = "give it one where it is declared or used: = ..."
    raise Diagnostic("F023", f"the {leaf.variability} {variable.name} has no value", leaf.span, hint)


def add_used_constants(model: flat.FlatModel, context: Context, expressions: list[Expr]) -> None:
    """Constants of packages that the model's expressions name."""
    pending = expressions
    while pending:
        added = []
        for name in dict.fromkeys(_names(pending)):
            if name not in model.variables and name in context.scalars:
                leaf, position = context.scalars[name]
                value = leaf.element(leaf.binding(), position)
                attributes = {k: leaf.element(leaf.attribute(k), position) for k in leaf.modifier.children}
                variable = _variable(leaf, position, {k: v for k, v in attributes.items() if v is not None})
                variable.binding = _parameter_value(leaf, variable, value, context)
                model.variables[name] = variable
                if variable.binding is not None:
                    added.append(variable.binding)
        pending = added


def _names(expressions: list[Expr]) -> list[str]:
    seen: set[Expr] = set()
    names = []
    stack = list(expressions)
    while stack:
        e = stack.pop()
        if e not in seen:
            seen.add(e)
            if e.op == "var":
                names.append(str(e.value))
            stack.extend(e.args)
    return names


def mark_evaluated(model: flat.FlatModel, names: Collection[str]) -> None:
    """Parameters of these names, those with Evaluate = true, and what they depend on are part of the structure."""
    pending = [v for v in model.variables.values() if v.evaluated or v.name in names]
    while pending:
        variable = pending.pop()
        variable.evaluated = True
        used = [model.variables[n] for n in _names([variable.binding])] if variable.binding is not None else []
        pending += [v for v in used if not v.evaluated and v.fixed is not ex.FALSE]


def mark_discrete(model: flat.FlatModel, targets: list[str]) -> None:
    """A Real that is assigned at events only is discrete, declared so or not."""
    for name in targets:
        variable = model.variables.get(name)
        if variable is not None and variable.variability == flat.CONTINUOUS:
            model.variables[name] = replace(variable, variability=flat.DISCRETE)
