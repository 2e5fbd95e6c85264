"""The open places of a model: each with an input, the equations linearised, those that are alike put together.

Two places are alike where an effort at one does to the states and outputs what an effort at the other does, whatever
the data: they are one place to this case, and its name is that of the state whose balance it is, or of the output that
it changes where it changes no state.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lacuna.codegen import flat
from lacuna.codegen.compile import translate
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic.expr import var
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.units.inference import UnitInference, of_variable
from lacuna.discovery.case.case_model import UNITS
from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.searched import write_source
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.linear import Linear
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.places.families import families
from lacuna.discovery.efforts.places.openable import openable, with_probes
from lacuna.discovery.efforts.places.place import (
    ORDER,
    Place,
    name_there,
    own_name,
    size_of,
    told_apart,
    touches,
    weightiest,
)
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.efforts.places.sites import Site, exchanges, renames, varying
from lacuna.discovery.fit.machine import Machine, richer
from lacuna.units import Unit

RENAMES = "it only gives a name to what is recorded: an error there is its sensor's"
BALANCES = ("node", "equation", "branch", "edge")  # kinds of places in one balance, or between two
ALIKE = 1e-5  # of a direction, by which two places may differ: rounding of the linearisation


@dataclass
class Opened:
    """The believed model with an input at every site, linearised; `closed` says what was not open, and why."""

    machine: Machine
    linear: Linear
    sites: list[Site]
    closed: list[tuple[str, str]]
    believed: Prepared  # without inputs, whose equations are as they were written

    @cached_property
    def hidden(self) -> frozenset[str]:
        """Variables and rates that no amended model can read: what is protected in components."""
        names = [n for n, v in self.believed.declared.variables.items() if v.hidden]
        return frozenset([*names, *(f"der({n})" for n in names)])

    @cached_property
    def _own(self) -> np.ndarray:
        """(x,) which states are the believed model's."""
        return np.array([not self.machine.amendment.adds(s) for s in self.linear.states])

    def places(self, along: Sequence[Along]) -> list[Place]:
        """Places that have an effect along these recordings, those alike put together: by what they do where both do
        something (what varies as a coefficient of a force that is off does nothing). First of those alike the one that
        changes least at once: its law may be of what the others change (friction in proportion to the force of a gas,
        in their sum)."""
        effect = self._effect(along)
        direction = _directions(effect)
        groups: list[list[int]] = []
        acting = np.abs(effect).max(axis=(0, 1)) > 0
        read = effect[:, : len(self.linear.states)].any(axis=(0, 1))
        for k in np.flatnonzero(acting & ~read):
            if renames(self.sites[k]):
                acting[k] = False
                self.closed.append((self.sites[k].label, RENAMES))
        for k in np.flatnonzero(acting):
            for group in groups:
                if _is_same(direction[:, :, k], direction[:, :, group[0]]):
                    group.append(k)
                    break
            else:
                groups.append([k])
        answering = np.any([a.answering for a in along], axis=0)
        answer = np.count_nonzero(answering, axis=0)  # unknowns that each changes at once
        groups = [sorted(group, key=lambda k: answer[k]) for group in groups]
        weights = np.linalg.norm(effect, axis=(0, 1)) * [size_of(own_name(site), along) for site in self.sites]
        found = told_apart([self._place(group, effect, weights) for group in groups])
        return self._with_families(found, groups, effect)

    def _with_families(self, places: list[Place], groups: list[list[int]], effect: np.ndarray) -> list[Place]:
        """The places and the families that they are of; of those whose members are the same places, the one that has
        the name of these, or is nearest to a balance. What one course in all of them does may be what an effort in one
        balance does, whose own place that is."""
        of = {k: n for n, group in enumerate(groups) for k in group}
        wholes: dict[frozenset[int], Place] = {}
        direction = _directions(effect[:, :, [g[0] for g in groups if any(self.sites[k].kind in BALANCES for k in g)]])
        for site, columns in sorted(families(self.sites, sorted(of)), key=lambda f: ORDER[f[0].parts[0].kind]):
            members = frozenset(of[k] for k in columns)
            sum_of = _directions(effect[:, :, list(columns)].sum(axis=2))
            own = not any(_is_same(sum_of, one) for one in np.moveaxis(direction, 2, 0))
            whole = Place(site.label, (site,), columns, self._unit(columns[0]), as_one=own)
            if members not in wholes or site.members[0] == places[of[columns[0]]].location:
                wholes[members] = whole
        return [*places, *wholes.values()]

    def _effect(self, along: Sequence[Along]) -> np.ndarray:
        """(n, x + y, sites): rates of the states and outputs, each in its own size, that an effort causes at once."""
        states, count = self.linear.states, len(self.sites)

        def course(name: str) -> np.ndarray:
            return np.concatenate([np.atleast_1d(a.values.get(name, np.ones(1))) for a in along])

        rates = [np.sqrt(np.mean(course(f"der({s})") ** 2)) or 1.0 for s in states]
        outputs = [np.std(course(v)) or 1.0 for v in self.machine.columns.values()]
        direct, feed = (np.concatenate([getattr(a, n) for a in along]) for n in ("direct", "feed"))
        sizes = np.array([*rates, *outputs])[None, :, None]
        return np.concatenate([direct[:, : len(states), :count], feed[:, :, :count]], axis=1) / sizes

    def _place(self, group: list[int], effect: np.ndarray, weights: np.ndarray) -> Place:
        states = self.linear.states
        strength = np.sqrt(np.mean(effect[:, :, group[0]] ** 2, axis=0))
        believed = strength[: len(states)] * self._own
        if believed.any():  # states of what was added give no place its name
            strength[: len(states)] = believed
        changed = states if strength[: len(states)].max(initial=0.0) > 0 else list(self.machine.columns.values())
        name = changed[int(np.argmax(strength[: len(states)] if changed is states else strength[len(states) :]))]
        location = name.rpartition(".")[0] or name
        order = sorted(group, key=lambda k: (not touches(self.sites[k], location), ORDER[self.sites[k].kind]))
        order = weightiest(order, self.sites, weights)
        chosen = order[0]
        several = np.count_nonzero(strength[: len(states)]) > 1
        if own := self._of_several(order) or (several and self._sent_to(order)):
            location = own
        sites, reading = tuple(self.sites[k] for k in order), changed is not states
        place = Place(location, sites, (chosen,), self._unit(chosen), reading=reading)
        told = [k for k in order[1:] if self.sites[k].kind == "input"]
        apart = _other(effect, sorted(order, key=lambda k: (k != chosen, k not in told)))
        inputs = [k for k in told if k not in apart]
        return replace(place, other=tuple(self._quantity(place, k, k in inputs) for k in (*apart, *inputs)))

    def _of_several(self, order: list[int]) -> str | None:
        """The name of a place of several balances: its own, or that of the component that it goes past."""
        sites = [self.sites[k] for k in order]
        past = {s.label for s in sites if s.kind == "branch"}
        several = all(s.kind in ("branch", "parameter", "input") or s.instance in past for s in sites)
        return next((s.label for s in sites if s.label in past), sites[0].label) if several else None

    def _sent_to(self, order: list[int]) -> str:
        """The component that a signal goes into, where what it sends is all that is told there; "" where it is not."""
        sites = [self.sites[k] for k in order]
        into = sites[0].into if all(s.kind == "signal" for s in sites) else ""
        return into.rpartition(".")[0] or into

    def _quantity(self, place: Place, k: int, proportional: bool) -> Place:
        """A place by another one of its sites."""
        site = self.sites[k]
        location, only = name_there(site, place.location), site.label if proportional else ""
        return replace(place, location=location, sites=(site,), columns=(k,), unit=self._unit(k), only=only)

    def _unit(self, number: int) -> str:
        return unit_of(self.sites[number], self.believed)


def _directions(effect: np.ndarray) -> np.ndarray:
    """What efforts do (n, x + y, ...) at each sample, of length one; zero where they do nothing."""
    return effect / np.maximum(np.linalg.norm(effect, axis=1, keepdims=True), 1e-300)


def _is_same(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two efforts act in the same direction (n, x + y), where both do something."""
    both = one.any(axis=1) & other.any(axis=1)
    cosine = np.abs(np.sum(one[both] * other[both], axis=1))
    return bool(both.any() and np.mean(1.0 - cosine) < ALIKE)


def unit_of(site: Site, prepared: Prepared) -> str:
    """The unit in which an equation of the class, or the first of two, stands; "" where it is not known."""
    if site.port is not None:
        carried = site.port.potential if site.kind == "edge" else site.port.flow
        return prepared.declared.variables[f"{site.ends[0]}.{carried}"].unit
    if site.kind in ("parameter", "input"):
        return prepared.declared.variables[site.label].unit
    if site.kind == "signal":
        return prepared.declared.variables[site.into].unit
    found = _balanced_in(site.parts[0] if site.parts else site, prepared)
    return str(found) if found is not None and found.factor == 1.0 else ""


def _balanced_in(site: Site, prepared: Prepared) -> Unit | None:
    """The unit of both sides of an equation, with its scale; None where it is not known."""
    left, declared = _left(site.local), prepared.declared
    alike = (e for e in declared.equations if e.origin == site.instance and _left(e.text) == left)
    equation = next(alike, None)
    inference = UnitInference(lambda e: _declared_unit(declared.variables, str(e.value)), lambda name: "")
    found = inference.of(equation.lhs) if equation is not None else None
    return found if isinstance(found, Unit) else None


def _left(text: str) -> str:
    return text.partition("=")[0].strip(" :")


def _other(effect: np.ndarray, order: list[int]) -> list[int]:
    """Of sites alike (in `order`), those whose strength changes along the recording, measured by that of the first and
    of the ones before them."""
    strengths = np.linalg.norm(effect, axis=1)
    kept = [order[0]]
    for k in order[1:]:
        if all(_parts(strengths[:, k], strengths[:, n]) for n in kept):
            kept.append(k)
    return kept[1:]


def _parts(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two courses are no multiples of each other."""
    return float(one @ other) ** 2 < (1.0 - ALIKE) * float(one @ one) * float(other @ other)


def _declared_unit(variables: Mapping, name: str) -> object:
    v = variables[name]
    return of_variable(v.unit, v.type, v.variability)


def opened(
    case: Case, amendment: Amendment, library: Library, parameters: list[str], base: Machine | None = None
) -> Opened:
    """The amended model, simulated as `base` is, with an input at every site where one can act."""
    found = read(library, amendment.structure.model)
    closed = list(found.closed)
    believed, _ = translate(str(write_source(amendment)), search_path=case.search_path, units=UNITS)
    between = exchanges(found.places, lambda site: str(_balanced_in(site, believed) or ""))
    vary = varying([*found.places, *found.inside], _read(believed, _scalars(believed)))
    told = [s.variable for s in case.inputs]
    acting = varying(found.places, _read(believed, told), "input")
    elsewhere = set(told) - {s.label for s in acting}
    closed += [(n, "it is read elsewhere than in equations of the class") for n in sorted(elsewhere)]
    sites = openable(case, amendment, [*found.places, *between, *vary, *acting], closed)
    whole = with_probes(amendment, sites)
    try:
        machine = richer(case, whole, base) if base else Machine(case, whole)
    except CaseError as reason:  # it has other states than those whose first values are known
        raise NotNumeric(str(reason)) from reason
    return Opened(machine, Linear(machine, list(whole.inputs), parameters), sites, closed, believed)


def _scalars(believed: Prepared) -> list[str]:
    """Real parameters of the model."""
    variables = believed.declared.variables
    return [n for n, v in variables.items() if v.type == "Real" and v.variability == flat.PARAMETER]


def _read(believed: Prepared, names: Iterable[str]) -> dict[str, int]:
    """Those that are no arrays and that nothing but equations reads, fields of records among them: how many, of each.
    None beside algorithms and when-clauses, in which they would stay."""
    if believed.declared.algorithms or believed.declared.whens:
        return {}
    variables = believed.declared.variables
    bound = {str(n.value) for v in variables.values() if v.binding is not None for n in leaves(v.binding)}
    plain = [n for n in names if n in variables and "[" not in n and n not in bound]
    reads = Counter(leaf for e in believed.declared.equations for leaf in leaves(e.lhs) | leaves(e.rhs))
    return {n: reads[var(n)] for n in plain}
