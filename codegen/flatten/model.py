"""The passes from a class to its flat model."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.instance import ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Given, Leaf
from lacuna.codegen.flatten.connections.balance import check_balance
from lacuna.codegen.flatten.connections.by_annotation import check_annotations
from lacuna.codegen.flatten.connections.connections import connection_equations
from lacuna.codegen.flatten.connections.expandable import expand
from lacuna.codegen.flatten.connections.local_balance import check_components
from lacuna.codegen.flatten.connections.streams import stream_variables
from lacuna.codegen.flatten.connections.structure import Structure
from lacuna.codegen.flatten.equations.algorithms import carriers, flatten_algorithm
from lacuna.codegen.flatten.equations.asserts import require_lasting
from lacuna.codegen.flatten.equations.equations import Collected, check_discrete
from lacuna.codegen.flatten.equations.sections import flatten_items, scope_of
from lacuna.codegen.flatten.equations.texts import bind_texts
from lacuna.codegen.flatten.equations.variables import (
    add_used_constants,
    flatten_variables,
    mark_discrete,
    mark_evaluated,
)
from lacuna.codegen.flatten.experiment import experiment_of
from lacuna.codegen.flatten.expressions.derivative import derivative_variables
from lacuna.codegen.flatten.expressions.operators import Required
from lacuna.codegen.flatten.language import LOWERING
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.unknown import unknown_element
from lacuna.codegen.flatten.references.written import check_written
from lacuna.codegen.flatten.untaken import check_untaken
from lacuna.codegen.library.classes import MODEL_KINDS, Library
from lacuna.codegen.library.renamed import warnings_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.rewrite import assigned, expressions, without_marks
from lacuna.codegen.syntax import ast
from lacuna.codegen.units.check import check_units, drop_unread, without_branches


def flatten(
    library: Library, name: str, modifications: dict[str, Expr | float] | None = None, units: str = "error"
) -> flat.FlatModel:
    """The flat model of class `name` (see `Library.find`), every check of the front end done.

    `modifications` set structural parameters by their full name; `units` is "error", "warn" (findings, and components
    and connectors that are not balanced by themselves, go to `FlatModel.warnings`), "all" (findings inside libraries
    are errors, too) or "off". Raises Diagnostic; further independent findings are in its `others`.
    """
    cls = library.find(name)
    if cls.kind not in MODEL_KINDS or cls.partial:
        what = f"partial {cls.kind}" if cls.partial else cls.kind
        inside = library.models(cls)[:5] if cls.kind == "package" else []
        hint = f"name a model in it, such as {' or '.join(inside)}" if inside else "name a complete model"
        raise Diagnostic("F003", f"{cls.path} is a {what}, not a model to simulate", cls.span, hint)
    library.forget_views()
    context = Context(library, Path(cls.span.file).resolve().parent, LOWERING, cls.path)
    top = Instance(context, cls, "", None, _outside_modifier(modifications or {}, cls.span, context.table(Given)))
    imbalance = "warning" if units == "warn" else "error"
    leaves, sections, buses = _instantiate(top, imbalance, modifications or {})
    context.finish()
    model = flat.FlatModel(cls.path, cls.span, cls.description)
    _flatten_variables(leaves, model, context)
    body, initial = _sections(sections)
    expand(body.connections, buses, context)
    _flatten_variables(_leaves_of(buses), model, context)
    model.equations += body.equations + connection_equations(body.connections, context)
    model.variables |= carriers(model, context)
    stream_variables(model, context)
    derivative_variables(model, context)
    context.finish()
    check_written(top)
    check_components(leaves, buses, body, context, imbalance)
    check_annotations(leaves, context)
    model.whens, model.algorithms, model.initial_equations = body.whens, body.algorithms, initial.equations
    model.asserts = body.asserts + initial.asserts + context.table(Required)
    model.functions, model.derivatives = context.functions, context.derivatives
    at_events = [*assigned(model.whens), *(n for a in model.algorithms for n in a.targets)]
    _check_events(model, body, leaves, set(at_events), context)
    mark_discrete(model, at_events)
    add_used_constants(model, context, list(_all_expressions(model)))
    mark_evaluated(model, context.evaluated)
    model.experiment = experiment_of(top)
    model = _check_units(model, context, units)
    model.files, model.warnings = {**library.files, **context.files}, [*context.warnings, *warnings_of(library)]
    model.foreign = context.table(flat.ForeignCode)
    context.finish()
    _look_beside(model, top)
    return model


def _refuse_what_is_not_set(leaves: Iterable[Leaf], modifications: Iterable[str], top: Instance) -> None:
    """Raises R031 for what is declared constant, which is fixed by the model (4.5), R032 for elements there are not."""
    wanted = set(modifications)
    elements = {n for n in wanted if "[" in n}
    for leaf in leaves:
        elements.difference_update(leaf.names)
        if leaf.variability == "constant" and not wanted.isdisjoint(leaf.names):
            hint = "declare it as a parameter, or modify it in a model"
            raise Diagnostic("R031", f"{leaf.name} is a constant, no parameter to be set", leaf.span, hint)
    if elements:
        raise unknown_element(top.cls, min(elements), top.elements, top.cls.span)


def _check_events(
    model: flat.FlatModel, body: Collected, leaves: list[Leaf], at_events: set[str], context: Context
) -> None:
    with context.attempt():
        require_lasting(body.asserts)
        check_discrete(model.equations, leaves, at_events, context)


def _look_beside(model: flat.FlatModel, top: Instance) -> None:
    """Checks of what the model leaves out; whatever they make belongs to the context alone."""
    model.functions = dict(model.functions)
    check_untaken(top)
    top.context.finish()


def _flatten_variables(leaves: Iterable[Leaf], model: flat.FlatModel, context: Context) -> None:
    for leaf in leaves:
        with context.attempt():
            flatten_variables(leaf, model)


def _check_units(model: flat.FlatModel, context: Context, mode: str) -> flat.FlatModel:
    """The findings to the context; the model without what only this check looks at, and units that cannot be read."""
    checked = without_marks(model) if context.literal_units or context.derivatives else model
    if mode != "off":
        _note_findings(model, context, mode)
    drop_unread(checked)
    without_branches(checked)
    return checked


def _note_findings(model: flat.FlatModel, context: Context, mode: str) -> None:
    package = context.library.foreign_package
    findings = check_units(
        model,
        context.argument_units,
        context.function_units,
        context.places,
        package,
        context.literal_units,
        context.bodies,
    )
    own = [f for f in findings if mode == "all" or not package(f.span.file)]
    told = [replace(f, severity="warning") for f in own] if mode == "warn" else own
    context.warnings += [f for f in told if f.severity == "warning"]
    context.errors += [f for f in told if f.severity == "error"]
    foreign = Counter(package(f.span.file) for f in findings if f not in own)
    for name, count in foreign.items():
        hint = "lacuna check --units all shows them"
        message = f"{count} places of the library {name} do not pass the unit check"
        context.warnings.append(Diagnostic("W007", message, hint=hint, severity="warning"))


def _outside_modifier(modifications: dict[str, Expr | float], span: Span, elements: Given) -> Modifier | None:
    """What is said of variables as a whole; what is said of elements of arrays goes to `elements`."""
    root = Modifier(span)
    for name, given in modifications.items():
        value = given if isinstance(given, Expr) else _number(given)
        if "[" in name:
            elements[name] = value
            continue
        at = root
        for part in name.split("."):
            at = at.children.setdefault(part, Modifier(span))
        at.value = value
    return root if root.children else None


def _number(value: float | int | bool) -> Expr:
    whole = not isinstance(value, bool) and float(value).is_integer()
    return ex.const(int(value) if whole else value)


def _instantiate(
    top: Instance, imbalance: str, modifications: Iterable[str]
) -> tuple[list[Leaf], list[tuple[ast.Section, ast.Class, Instance]], list[Instance]]:
    """Every variable and every section below `top`, in order of declaration, and the expandable connectors: what they
    hold follows from the connections. Connectors that are not balanced are of that severity; constants among what is
    modified from outside are refused."""
    buses: list[Instance] = []
    leaves: list[Leaf] = []
    sections: list[tuple[ast.Section, ast.Class, Instance]] = []

    def visit(instance: Instance) -> None:
        if instance.cls.expandable:
            buses.append(instance)
            return
        if instance.cls.kind == "connector" and not (instance.parent is not None and instance.parent.in_connector):
            with instance.context.attempt():
                check_balance(instance, imbalance)
        look_at(instance, list(instance.elements))
        sections.extend((section, cls, instance) for section, cls in instance.sections)

    def look_at(instance: Instance, elements: list[str]) -> None:
        for element in elements:
            with instance.context.attempt():
                node = instance.child(element)
                declaration = instance.elements[element].declaration
                outer = declaration.outer and not declaration.inner
                if isinstance(node, Leaf) and not outer:
                    leaves.append(node)
                elif isinstance(node, Instance) and not outer:
                    visit(node)
                elif isinstance(node, ArrayNode) and not outer:
                    for item in node.items:
                        visit(item)

    declared = set(top.elements)
    visit(top)
    while implicit := [name for name in top.elements if name not in declared]:  # inner ones that were asked for (5.4)
        declared.update(implicit)
        look_at(top, implicit)
    bind_texts(sections)
    top.context.table(Structure).sections = sections
    _refuse_what_is_not_set(leaves, modifications, top)
    return leaves, sections, buses


def _leaves_of(nodes: Iterable[Node]) -> Iterator[Leaf]:
    """The variables that expandable connectors have come to hold."""
    for node in nodes:
        if isinstance(node, Leaf):
            yield node
        elif isinstance(node, ArrayNode):
            yield from _leaves_of(node.items)
        elif isinstance(node, Instance):
            yield from _leaves_of(node.child(name) for name in node.present)


def _refuse_lasting(initial: Collected) -> None:
    """Raises F031 for what goes on after the start, in an initial section."""
    places = [w.span for w in initial.whens] + [connect.span for connect, _ in initial.connections]
    places += [s.span for a in initial.algorithms for s in a.statements if isinstance(s, flat.When)]
    if places:
        initial.whens, initial.connections, initial.algorithms = [], [], []
        hint = "write equations between initial values"
        raise Diagnostic("F031", "'when' or 'connect' in an initial section", places[0], hint)


def _sections(sections: list[tuple[ast.Section, ast.Class, Instance]]) -> tuple[Collected, Collected]:
    body, initial = Collected(), Collected()
    for section, cls, instance in sections:
        context = instance.context
        scope = scope_of(section, cls, instance)
        out = initial if section.initial else body
        with context.attempt():
            if section.algorithm:
                flatten_algorithm(section, scope, out)
            else:
                flatten_items(section.items, scope, out)
            if section.initial:
                _refuse_lasting(initial)
    return body, initial


def _all_expressions(model: flat.FlatModel) -> Iterator[Expr]:
    for e in (*model.equations, *model.initial_equations):
        yield e.lhs
        yield e.rhs
    for v in model.variables.values():
        yield from (x for x in (v.binding, v.start, v.fixed, v.min, v.max, v.nominal) if x is not None)
    yield from expressions([*model.whens, *(s for a in model.algorithms for s in a.statements), *model.asserts])
    for f in model.functions.values():
        yield from f.defaults.values()
        yield from expressions(f.body)
    yield from (r.value for rules in model.derivatives.values() for r in rules if isinstance(r.value, Expr))
