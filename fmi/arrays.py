"""Arrays of FMI 3.0: elements that stand one after another in the model's variable table and have one role."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import product
import math
import re

from lacuna.fmi.variable import FmiVariable
import lacuna.runtime as runtime

_ELEMENT = re.compile(r"(?P<array>.+)\[(?P<subscripts>\d+(?:,\s*\d+)*)\]")
_MORE = ("fixed", "tunable", "discrete", "continuous")  # each allows more changes than the one before


@dataclass(frozen=True)
class Array:
    """`elements` are all of it, in the order of its subscripts, the last running first."""

    name: str
    dimensions: tuple[int, ...]
    elements: tuple[runtime.Variable, ...]


def arrays_of(variables: Iterable[runtime.Variable]) -> list[Array]:
    """The arrays among `variables`, which are in the order of their rows; parts of one are none."""
    runs: list[tuple[str, list[tuple[int, ...]], list[runtime.Variable]]] = []
    for v in variables:
        found = _ELEMENT.fullmatch(v.name)
        if not found:
            continue
        at = tuple(map(int, found["subscripts"].split(",")))
        if not runs or runs[-1][0] != found["array"] or runs[-1][2][-1].row + 1 != v.row:
            runs.append((found["array"], [], []))
        runs[-1][1].append(at)
        runs[-1][2].append(v)
    return [
        Array(name, places[-1], tuple(elements)) for name, places, elements in runs
        if places == list(product(*(range(1, size + 1) for size in places[-1])))
    ]  # fmt: skip


def states_of(array: Array) -> bool:
    """Whether the array is a vector of states: one after another, as FMI has the elements of an array."""
    first = array.elements[0].index
    return all(v.kind == "state" and v.sign == 1 and v.index == first + k for k, v in enumerate(array.elements))


def joined(listed: Iterable[FmiVariable], arrays: Iterable[Array]) -> list[FmiVariable]:
    """`listed` with one variable for the elements of each array that FMI can have as one, and one for the derivatives
    of an array of states. Elements of different roles, units or bounds stay as they are."""
    listed = list(listed)
    known = {v.reference: v for v in listed}
    derivatives = {v.derivative_of: v for v in listed if v.derivative_of is not None}
    whole, gone = {}, set()
    for array in arrays:
        if len({v.unit for v in array.elements}) > 1:
            continue
        elements = [known[1 + v.row] for v in array.elements]
        for part, name in _parts(elements, derivatives, array.name):
            one = _one(part, name, array.dimensions)
            if one is None:
                break
            whole[one.reference] = one
            gone |= {v.reference for v in part[1:]}
    return [whole.get(v.reference, v) for v in listed if v.reference not in gone]


def _parts(
    elements: list[FmiVariable], derivatives: Mapping[int, FmiVariable], name: str
) -> list[tuple[list[FmiVariable], str]]:
    """What becomes one variable: the elements, and their derivatives where they are states. Nothing where only some
    are, or where their derivatives do not follow each other."""
    slopes = [derivatives[v.reference] for v in elements if v.reference in derivatives]
    if not slopes:
        return [(elements, name)]
    together = [v.reference for v in slopes] == list(range(slopes[0].reference, slopes[0].reference + len(elements)))
    return [(elements, name), (slopes, f"der({name})")] if together else []


def _one(elements: list[FmiVariable], name: str, dimensions: tuple[int, ...]) -> FmiVariable | None:
    """None where the elements differ in more than their values."""
    starts = [v.start for v in elements]
    variability = max((v.variability for v in elements), key=_MORE.index)
    unit = (
        elements[0].unit if len({v.unit for v in elements}) == 1 else ""
    )  # declared ones are equal: these are inferred
    first = replace(elements[0], name=name, start=None, dimensions=dimensions, variability=variability, unit=unit)
    if first.derivative_of is not None:
        first = replace(first, description=f"derivative of {name.removeprefix('der(')[:-1]} by time")
    computed = first.causality in ("local", "output")
    for v in elements:
        if _role(v, computed) != _role(elements[0], computed) or (v.start is None) != (starts[0] is None):
            return None
    return first if starts[0] is None else replace(first, start=tuple(starts))


def _role(v: FmiVariable, computed: bool) -> FmiVariable:
    """What elements have to share. Of those that are computed one may change where another does not."""
    own = replace(v, name="", reference=0, start=None, unit="", derivative_of=None)
    own = replace(own, description="") if v.derivative_of is not None else own
    return replace(own, variability="") if computed else own


def extents(variables: Iterable[FmiVariable]) -> dict[int, int]:
    """Number of values of each array, by its value reference, in ascending order."""
    found = {v.reference: math.prod(v.dimensions) for v in variables if v.dimensions}
    return dict(sorted(found.items()))
