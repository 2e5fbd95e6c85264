"""The faults of one actuator beside each other: one history a fault, and a new part is new in all of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.history import History

OWN = ""  # how a table that names no fault means the map's own


def tracks(histories: Sequence[History], own: Collection[str]) -> list[History]:
    """The histories with one of each fault: `own` are the names of the map's own fault, and to leave it empty is one
    of them. A part that was replaced by a row of one fault is new in all others from that use on. Raises AnalysisError
    where rows that are of one fault count the same use."""
    names = {h.fault for h in histories} & {OWN, *own}
    found: dict[str, dict[str, History]] = {}
    for h in histories:
        faults, fault = found.setdefault(h.actuator, {}), OWN if h.fault in names and len(names) > 1 else h.fault
        faults[fault] = _joined(faults[fault], h) if fault in faults else replace(h, fault=fault)
    return [h for faults in found.values() for h in _renewed(faults.values())]


def _joined(one: History, other: History) -> History:
    """Both in order of use, under the name of the first."""
    use = np.concatenate([one.use, other.use])
    order = np.argsort(use, kind="stable")
    if np.any(np.diff(use[order]) <= 0):
        same = use[order][1:][np.diff(use[order]) <= 0][0]
        raise AnalysisError(
            f"actuator {one.actuator}: two tests at {one.unit} {same:g}: a row of fault {other.fault!r} is one of the "
            "map's own fault, as is a row that names none; leave one"
        )
    columns = {
        name: np.concatenate([getattr(one, name), getattr(other, name)])[order]
        for name in ("severity", "low", "high", "replaced")
    }
    said = {name: tuple(dict.fromkeys(getattr(one, name) + getattr(other, name))) for name in ("warnings", "doubts")}
    return replace(one, use=use[order], **columns, **said)


def _renewed(faults: Iterable[History]) -> list[History]:
    """Those of one actuator, each with a new part at its first test from every replacement on."""
    faults = list(faults)
    at = np.unique(np.concatenate([h.use[h.replaced] for h in faults]))
    if len(faults) == 1 or not len(at):
        return faults
    first = [np.searchsorted(h.use, at) for h in faults]
    return [replace(h, replaced=np.isin(np.arange(len(h.use)), k)) for h, k in zip(faults, first, strict=True)]
