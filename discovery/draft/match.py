"""Which variable of a model a column records: by its name, and by the dimension of its unit."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
import re

from lacuna.analysis.recording.heads import Head
from lacuna.recorded_units import cycles_for_angle, same_dimension, to_si
from lacuna.suggest import distance


@dataclass(frozen=True)
class Target:
    """A variable that a column may record; `discrete`: a Boolean or an Integer, which holds its value."""

    name: str
    unit: str
    is_input: bool
    description: str = ""
    discrete: bool = False


@dataclass(frozen=True)
class Match:
    """`target` is None where nothing fits; `others` could be meant as well, the likeliest first."""

    head: Head
    target: Target | None
    others: tuple[Target, ...] = ()
    sure: bool = False


def matched(heads: Sequence[Head], targets: Iterable[Target]) -> list[Match]:
    """The match of each column. A variable is given to one column only: to the one that is likest."""
    targets = list(targets)
    scores = [{t: s for t in targets if (s := likeness(head, t)) > 0} for head in heads]
    taken: dict[int, Target] = {}
    pairs = [(s, k, t) for k, row in enumerate(scores) for t, s in row.items()]
    for _score, k, target in sorted(pairs, key=lambda pair: -pair[0]):  # of equal ones the first in the model
        if k not in taken and target not in taken.values():
            taken[k] = target
    return [_match(head, scores[k], taken.get(k)) for k, head in enumerate(heads)]


def _match(head: Head, scores: dict[Target, float], target: Target | None) -> Match:
    if target is None:
        return Match(head, None)
    head = _of(head, target)
    others = sorted((t for t in scores if t != target), key=lambda t: -scores[t])
    # Sure: the names say the same and the unit agrees, or nothing else has this dimension.
    said = head.unit is not None or target.discrete
    sure = said and (scores[target] >= SAME_NAME or not others)
    return Match(head, target, tuple(others[:4]), sure)


SAME_NAME = 2.0  # the names are the same, whatever the case; above it only what breaks ties


def likeness(head: Head, target: Target) -> float:
    """0 where the units contradict; 2 and more for the same name, 1 to 2 for a like one, below 1 for the unit alone."""
    head = _of(head, target)
    if head.unit is not None and not _may_be(head.unit, target.unit):
        return 0.0
    # Of two alike the outer one, nearer to what an engineer instruments; inputs before what follows from them.
    tie = 0.1 / (1 + target.name.count(".")) + (0.05 if target.is_input else 0.0)
    name = max(_alike(head.name, target.name), _alike(head.name, target.name.rpartition(".")[2]), _said(head, target))
    if name == 1.0:
        return SAME_NAME + tie
    if name > 0.5:
        return 1.0 + name / 2 + tie
    return 0.5 + tie if head.unit is not None and head.unit != "1" else 0.0


def _of(head: Head, target: Target) -> Head:
    """What the head says of this variable: the end of a name is a unit only where the variable is of its quantity."""
    believed = head.unit is None or head.sure or _may_be(head.unit, target.unit)
    return head if believed else Head(head.text, head.text, None, sure=False)


def _alike(a: str, b: str) -> float:
    """1 for the same letters and digits, less for each that differs; a number at the end counts little: w1 is a w."""
    a, b = (re.sub(r"[^0-9a-z]", "", name.lower()) for name in (a, b))
    if not a or not b:
        return 0.0
    if a == b:
        return 1.0
    if a.rstrip("0123456789") == b.rstrip("0123456789"):
        return 0.9
    return max(0.0, 1 - distance(a, b) / max(len(a), len(b))) if min(len(a), len(b)) > 2 else 0.0


def _said(head: Head, target: Target) -> float:
    """Whether the variable's description holds the column's name as a word: `Supply voltage` and `voltage`."""
    words = re.findall(r"[a-z]{4,}", target.description.lower())
    names = re.findall(r"[a-z]{4,}", head.name.lower())
    return 0.8 if names and all(n in words for n in names) else 0.0


def _may_be(recorded: str, declared: str) -> bool:
    if not declared:
        return True  # a variable without unit makes no claim
    _, si = to_si(recorded)
    try:
        return same_dimension(si, declared) and not cycles_for_angle(si, declared)
    except ValueError:
        return True
