"""Relations that compare what events set, or what equations make of it, without deciding about it: `on = e > limit`
with `e = x - y` and a y that it sets. All equations hold together at an event (Modelica 3.6, 8.5 and B.1), so what
else the event does has to find them as they are with what is set, not as they were on arrival. Relations that what they
compare follows in turn (modes of friction, diodes) are none of these: they are iterated from one pass to the next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import DiscreteEquation, EventStep, expressions_of_step, targets
from lacuna.codegen.dae.relations import Relation
from lacuna.codegen.structure.causal import Step, expressions_of, unknowns_of
from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.symbolic.expr import Expr, var
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import assigned


def followers(steps: Sequence[EventStep], explicit: Sequence[Step], relations: Sequence[Relation]) -> frozenset[int]:
    """Numbers of such relations that something with a memory reads: a when-clause, an algorithm, what reads pre(n).
    What else there is follows them in the next pass."""
    made = [(unknowns_of(s), expressions_of(s)) for s in explicit]
    first_relation = len(made)
    made += [([], [r.left, r.right]) for r in relations]
    first_part = len(made)
    parts = [part for step in steps for part in _parts(step)]
    made += [([var(n) for n in targets(p)], expressions_of_step(p)) for p in parts]
    maker = {_key(unknown): k for k, (unknowns, _) in enumerate(made) for unknown in unknowns}
    maker |= {("rel", k): first_relation + k for k in range(len(relations))}
    needs = [sorted({maker[key] for e in used for n in leaves(e) if (key := _key(n)) in maker}) for _, used in made]
    follow, alone = set(range(first_part, len(made))), set()
    decide = {first_part + k for k, part in enumerate(parts) if _remembers(part)}
    components = strong_components(needs)  # each after what it needs
    for component in components:
        if len(component) == 1 and component[0] not in needs[component[0]]:
            alone.add(component[0])
        if any(n in follow for k in component for n in needs[k]):
            follow.update(component)
    for component in reversed(components):
        if any(k in decide for k in component):
            decide.update(n for k in component for n in needs[k])
    found = range(first_relation, first_part)
    return frozenset(k - first_relation for k in set(found) & follow & decide & alone)


def _parts(step: EventStep) -> list[EventStep]:
    """What a step says of each variable: when-equations hold side by side, the statements of an algorithm in order."""
    if not isinstance(step, flat.When):
        return [step]
    names = [*targets(step), None]  # none: reinit, assert, terminate
    parts = ([(c, [s for s in b if n in (assigned([s]) or [None])]) for c, b in step.branches] for n in names)
    return [replace(step, branches=branches) for branches in parts]


def _remembers(step: EventStep) -> bool:
    level = isinstance(step, DiscreteEquation)
    return not level or any(n.op == "pre" for e in expressions_of_step(step) for n in leaves(e))


def _key(n: Expr) -> object:
    return (n.op, n.value) if n.op in ("var", "rel") else n
