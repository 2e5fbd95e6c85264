"""Components are balanced: each has as many equations as unknowns of its own (Modelica 3.6, 4.8).

A potential of a connector that is connected on the inside needs no equation, a flow never does: connections give one
for each, whatever is connected.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.classes.types import EXTERNAL
from lacuna.codegen.flatten.connections.balance import Uneven
from lacuna.codegen.flatten.connections.connection_sets import ConnectionSets
from lacuna.codegen.flatten.equations.algorithms import Carried
from lacuna.codegen.flatten.equations.equations import Collected
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.symbolic.rewrite import assigned

_PARTS = ("record", "connector", "type")  # classes whose variables count as those of the model around


def check_components(
    leaves: Iterable[Leaf], buses: list[Instance], body: Collected, context: Context, severity: str = "error"
) -> None:
    """Notes R078, of that severity, for classes of components that are not balanced: whether the whole model is, is
    another question, which its structure answers. An input of a component may be given by an equation of the
    model around it, as people write it, though 4.8 wants a binding: it is an unknown of that model.

    Not judged are models with expandable, overdetermined or uneven connectors and those that use outer components: what
    holds there is decided by connections elsewhere.
    """
    if body.branches:
        return
    count = _Count(context, body)
    for leaf in leaves:
        if not leaf.is_structural and leaf.primitive not in ("String", EXTERNAL):
            count.add(leaf)
    owners = [_owner(connector) for connector in (*buses, *context.table(Uneven))]
    open_ended = {id(owner) for owner in owners} | {id(owner.parent) for owner in owners}
    refused: dict[tuple[object, int], list[Instance]] = {}  # by class and by what is too many or too few
    for instance in count.instances.values():
        if instance.parent is not None and id(instance) not in open_ended and not _uses_outer(instance):
            missing = count.unknowns[instance.name] - count.equations[instance.name]
            if not 0 <= missing <= count.defaults[instance.name]:
                refused.setdefault((instance.cls, missing), []).append(instance)
    for instances in refused.values():
        finding = _unbalanced(instances, count, severity)
        with context.attempt():
            if severity == "error":
                raise finding
            context.warnings.append(finding)


def _owner(instance: Instance) -> Instance:
    """The model or block whose variable an element of a record or connector is."""
    while instance.parent is not None and (instance.cls.kind in _PARTS or instance.in_connector):
        instance = instance.parent
    return instance


def _uses_outer(instance: Instance) -> bool:
    return any(e.declaration.outer for e in instance.elements.values())


def _given_from_outside(leaf: Leaf) -> bool:
    """Is it a public input?"""
    if leaf.causality != "input" or leaf.declaration.protected:
        return False
    around = leaf.instance
    while around is not _owner(leaf.instance):
        if around.declaration is not None and around.declaration.protected:
            return False
        around = around.parent
    return True


def _is_connector(leaf: Leaf) -> bool:
    """Is it a connector by itself, or part of one?"""
    return leaf.instance.in_connector or (leaf.type.named is not None and leaf.type.named.kind == "connector")


class _Count:
    """Equations and unknowns of each model and block, by the path of the component."""

    def __init__(self, context: Context, body: Collected) -> None:
        sets = context.table(ConnectionSets)
        self.instances: dict[str, Instance] = {}
        self.equations: Counter[str] = Counter(e.origin for e in body.equations)
        self.unknowns: Counter[str] = Counter()
        self.defaults: Counter[str] = Counter()  # what a class gives its own inputs: an equation, or a value by default
        self._connected = sets.outside
        carried = context.table(Carried)  # hold what is assigned to elements for a while: no unknowns of a class
        for when in body.whens:
            self.equations[when.origin] += len(set(assigned([when])).difference(carried))
        for algorithm in body.algorithms:
            self.equations[algorithm.origin] += len(set(algorithm.targets).difference(carried))
        for group in sets.sources.groups():
            self.equations[group[0][0]] += len(group) - 1

    def add(self, leaf: Leaf) -> None:
        """Count one declared variable."""
        owner, size = _owner(leaf.instance), len(leaf.names)
        self.instances[owner.name] = owner
        bound = 0 if leaf.binding() is None else size
        outside = _given_from_outside(leaf)
        if outside and not _is_connector(leaf) and leaf.binding() is not None:
            return
        own = not outside or (leaf.modifier.scope is not None and leaf.modifier.scope.instance is owner)
        if own:
            (self.defaults if outside else self.equations)[owner.name] += bound
        if outside:
            if owner.parent is not None:
                self.unknowns[owner.parent.name] += size
                self.equations[owner.parent.name] += 0 if own else bound
            return
        if leaf.flow:
            return
        connected = sum((owner.name, name) in self._connected for name in leaf.names)
        self.unknowns[owner.name] += size - connected


def _unbalanced(instances: list[Instance], count: _Count, severity: str) -> Diagnostic:
    """What is wrong with components of one class, said once."""
    instance = instances[0]
    equations, unknowns = count.equations[instance.name], count.unknowns[instance.name]
    cls = instance.cls
    message = f"{cls.name} is not balanced: {equations} equations for {unknowns} unknowns of its own"
    hint = "each class has as many equations as it declares unknowns, one for each pair of a potential and a flow"
    if unknowns > equations:
        hint += "; what the model around says of it is declared as an input there: input Real x"
    error = Diagnostic("R078", message, (cls.origin or cls).span, hint, severity=severity)
    others = len(instances) - 1
    more = f" (and so {'are' if others > 1 else 'is'} {others} more)" if others else ""
    error.notes.append((instance.span, f"as {instance.name} is declared here{more}"))
    return error
