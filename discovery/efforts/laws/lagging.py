"""Terms with states of their own: what relaxes, swings, arrives late, warms or ages behind a variable. Texts are
Modelica."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.places.insertion import KEPT
from lacuna.discovery.law.terms.law_terms import Group, Shape, Variable

DAMPED = 0.1  # damping ratio of what swings, where it starts: as most joints and mounts have
OCTAVES = 3.0  # from one time constant of a relaxation to the next: half a bandwidth either way


def remembering(v: Variable, found: Sequence[Variable], interval: float, duration: float) -> list[Group]:
    """A relaxation: storage behind a resistance, a damper behind a spring, a winding around a core, besides what is
    believed to be stored or a part of it, then behind the resistance; no faster than samples, no slower than a run. At
    rest at the start, or empty, as one that has just been added to."""
    times, behind = _times(interval, duration), ("lag", "warmth")
    relaxing = [f"({v.scaled} - {kind}({v.scaled}, {{t}}))" for kind in behind]
    part = [w.scaled for w in found if w.name == f"der({v.name})"]
    return [Group((r, *p), (s,)) for r in relaxing for p in ([], part)[: 1 + len(part)] for s in times]


def swinging(v: Variable, found: Sequence[Variable], interval: float, duration: float) -> list[Group]:
    """A mass on a spring of its own, besides what is believed to move or a part of it, which then goes from the rest;
    from three cycles of a recording to three samples a cycle, half a bandwidth apart."""
    low, high = 2 * np.pi * 3 / duration, 2 * np.pi / (3 * interval)
    part = [w.scaled for w in found if w.name == f"der({v.name})"]
    result = []
    for w in low * (1 + DAMPED) ** np.arange(np.log(high / low) / np.log1p(DAMPED)):
        shapes = (
            Shape("w", "rad/s", float(w), low / 3, 3 * high, (), DAMPED * float(w)),
            Shape("z", "1", DAMPED, DAMPED / 1e3, 0.9),
        )
        texts = [f"swing({v.scaled}, {{w}}, {{z}})", *part]
        result += [Group((texts[0],), shapes), *([Group(tuple(texts), shapes)] if part else [])]
    return result


def late(v: Variable, interval: float, duration: float) -> list[Group]:
    """A command that arrives late: kept in so many samples that the delay is of tens of them at least, or of few of the
    recording's own. Before a recording it was what it is at its start, or nothing was commanded."""
    result = []
    for shape in _times(interval, duration):
        apart = interval * np.ceil(OCTAVES * shape.start / ((KEPT - 1) * interval))
        own = replace(shape, upper=(KEPT - 1) * float(apart))
        result += [
            Group((f"({v.scaled} - {before}({v.scaled}, {{t}}, {apart:.6g}))",), (own,))
            for before in ("delay", "onset")
        ]
    return result


def ageing(
    factor: str, done: Sequence[str], interval: float, duration: float, beyond: tuple[Shape, ...] = ()
) -> list[Group]:  # fmt: skip
    """What has changed by what was done since the start, any of so many quantities, of which one goes `beyond` a
    threshold, and is in proportion to a factor ("" for a coefficient by itself): a winding that is warm, a filter that
    clogs by all that went through, a surface that fouls up to what the flow tears off again, a catalyst that is spent,
    a rubber that softens along its way, frost that grows on what is cold. What it remembers for less than a thirtieth
    of a run follows what is done: terms without a memory are of that."""
    slow = [s for s in _times(interval, duration) if 30 * s.start >= duration]
    whole = Shape("t", "s", duration / 3, interval, 9 * duration, (), 0.6 * duration / 3)
    kinds = [("total", (), f"{duration:.6g}"), *(("warmth", (s,), "{t}") for s in slow)]
    kinds += [("spent", (replace(whole, start=t, step=0.6 * t),), "{t}") for t in (duration / 9, duration / 3)]
    behind = factor and f"{factor}*"
    return [Group((f"{behind}{kind}({g}, {t})",), (*beyond, *shapes)) for g in done for kind, shapes, t in kinds]


def _times(interval: float, duration: float) -> list[Shape]:
    """Time constants between the samples' interval and a recording's duration."""
    count = max(2, int(np.ceil(np.log(duration / interval) / np.log(OCTAVES))))
    times = [float(t) for t in interval * OCTAVES ** (np.arange(count) + 0.5) if t < duration]
    return [Shape("t", "s", t, max(t / 9, interval), t * 9, (), 0.6 * t) for t in times]
