"""Recordings of more samples than fits need: outputs are compared at one sample in so many, inputs drive as they are.

What is held of a recording while hypotheses are fitted, its answers to every parameter, then has a bound, whatever its
length. Noise is that of all samples: from one that is left to the next the machine moves.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.noise import Noise
from lacuna.discovery.case.recordings_check import Problem

MOST = 2**17  # samples of a case: two outputs' answers to thirty parameters are 60 MB then, and a search has dozens


def thinned(case: Case, noise: dict[str, Noise]) -> Case:
    """The case, whose outputs have this noise, with no more than MOST samples; itself where it has no more."""
    every = -(-sum(len(r.time) for r in (*case.fit, *case.validate)) // MOST)
    if every == 1:
        return case
    fit, validate = ([_thinned(case, r, every) for r in rs] for rs in (case.fit, case.validate))
    return replace(case, fit=fit, validate=validate, noise=noise)


def _thinned(case: Case, recording: Recording, every: int) -> Recording:
    """One in so many of the samples that each output has, whatever its rate, the first row and the last."""
    own = [np.flatnonzero(np.isfinite(recording.columns[s.column]))[::every] for s in case.outputs]
    rows = np.unique(np.concatenate([*own, [0, len(recording.time) - 1]]))
    drives = {s.column: recording.drive(s.column) for s in case.inputs}
    columns = {c: v[rows] for c, v in recording.columns.items()}
    return replace(recording, time=recording.time[rows], columns=columns, drives=drives)


def said_of(case: Case) -> list[Problem]:
    """That the recordings of a case are thinned, for the report."""
    text = "there are more samples than fits need: outputs are compared at {} of {}, inputs drive as they were recorded"
    found = ((r, s.column, len(r.drive(s.column)[0])) for r in (*case.fit, *case.validate) for s in case.inputs[:1])
    return [
        Problem("thinned", r.name, column, None, text.format(len(r.time), whole), False)
        for r, column, whole in found if whole > len(r.time)
    ]  # fmt: skip
