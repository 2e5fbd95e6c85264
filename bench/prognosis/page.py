"""docs/prognosis.md: what was measured, beside what was aimed at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bench.prognosis.oracle import Oracle
from bench.prognosis.scores import CHECKPOINTS, Scores
from bench.prognosis.study import Arm, Removals

PAGE = """# Prognosis, measured

Written by `make prognosis` (seed {seed}, version {version}); do not edit. {count} of the {planned} planned parts,
each with a life by a law drawn from six that are much like the catalogue's and four that it lacks ({outside} parts:
slow start, knee, seasons, shocks), with a wandering rate, written in `bench/prognosis/` without a line of the
filter. Tests come at irregular intervals, 20 to 120 a life; 5 % are missing, 2 % outliers, a tenth of the parts
follows another one. Each test is read as a simulated pre-flight test of [robustness.md](robustness.md) was read, its
friction and inertia those of the actuator for life. Forecasts are made at every tenth of life, with what is known
then. The filter was developed on other seeds; this seed, scores and goals were committed before the first run. How
it is done: [forecast.md](forecast.md).

## Goals

| | goal | with the fleet's past | alone |
| --- | --- | --- | --- |
{goals}

*With the fleet's past*: the prior is learnt from {past} more parts of the fleet whose lives have ended, as the
command does where a history has twenty or more of them. *Alone*: every actuator by itself, with the prior that knows
no fleet.

*What can be reached*: the fleet's own generator turned round (`bench/prognosis/oracle.py`, no filter of ours).
Particles of its exact laws, shapes, lives, process noise and errors of reading, told all but which part this is, give
the posterior of the remaining life. The best figure that there is under it is within 20 % with a chance of
**{best}** from half of life on, and {best_early} at 30 and 40 %, on the first {oracle} parts.
No method that knows the population, and no more, can expect more:
**{reach}**.
A fault that will accelerate and one that will not read alike within the error of a test for half of their life.
Told the law of the part as well, it is {best_law} for those of the catalogue's kind;
told the law's shape besides, {best_shape}.
The posterior's own 95 % interval holds in {oracle95}.

## By share of life

| share of life | {shares} |
| --- | {dashes} |
{table}

Alpha-lambda counts every part: one that is not forecast is not within 20 %. CRPS is the mean over all parts, in lives.
The prognostic horizon (from which on every median is within 20 % of a life) is {horizon:.0f} % of life in the median.

## By law

| law | parts | 95 % interval holds, all tenths | within 20 % at half of life | at 80 % |
| --- | --- | --- | --- | --- |
{laws}

## Removals

{removals_text}

| method | missed: the limit first | removed before 70 % of life | median share of life used |
| --- | --- | --- | --- |
{removals}

## Two faults

{two_faults}

## progpy

{progpy}
"""


LATE = np.array(CHECKPOINTS) >= 0.5


@dataclass(frozen=True)
class Rivals:
    """Beside ours, with the rows of the fleet that they are of: `line` of all, the oracles told the population of
    `watched`, told the law (and shape) of `watched_known`; progpy of `known`, None where it is not installed."""

    line: Scores
    watched: np.ndarray
    population: Oracle
    watched_known: np.ndarray
    law: Oracle
    shape: Oracle
    known: np.ndarray
    progpy_law: Scores | None
    progpy_shape: Scores | None


def reach(best: np.ndarray, goal: float = 0.85) -> str:
    """What the greatest chances at the checkpoints say of the goal."""
    missing = [f"{100 * c:.0f} %" for c, b in zip(CHECKPOINTS, best, strict=True) if c >= 0.5 and b < goal]
    if not missing:
        return f"{100 * goal:.0f} % could be reached"
    return f"{100 * goal:.0f} % cannot be reached on this fleet at {', '.join(missing)} of life"


def spread(values: np.ndarray) -> str:
    return f"{100 * values.min():.1f} to {100 * values.max():.1f} %"


def goals(arms: Sequence[Arm], rivals: Rivals, unknown: np.ndarray) -> list[str]:
    """The lines of the goals: each with what every arm measured, and whether it is met."""
    columns = [_measured(arm, rivals, unknown) for arm in arms]
    lines = []
    for name, goal in GOALS.items():
        cells = [
            f"{text} {'' if met is None else 'met' if met else '**missed**'}"
            for text, met in (c[name] for c in columns)
        ]
        lines.append("| " + " | ".join([name, goal, *cells]) + " |")
    return lines


GOALS = {
    "95 % interval holds, every tenth from 30 %": "92 to 98 %",
    "80 % interval holds": "76 to 84 %",
    "CRPS over that of a straight line": "at most 0.7",
    "CRPS over that of progpy told the law": "at most 1.0",
    "the same, progpy told the part's own shape as well": "none",
    "within 20 % from half of life on": "at least 85 %",
    "missed removals": "at most 0.5 %",
    "removals before 70 % of life": "at most 5 %",
    "95 % interval holds, laws outside the catalogue": "above 90 %",
}


def _measured(arm: Arm, rivals: Rivals, unknown: np.ndarray) -> dict[str, tuple[str, bool | None]]:
    s, out = arm.scores, arm.removals
    c95, c80 = s.coverage(0, 4), s.coverage(1, 3)
    late = s.alpha_lambda()[LATE]
    ratio = s.crps.mean() / rivals.line.crps.mean()
    beside, told_more = (
        np.nan if p is None else s.rows(rivals.known).crps.mean() / p.crps.mean()
        for p in (rivals.progpy_law, rivals.progpy_shape)
    )
    outer = s.rows(unknown)
    outside = (outer.coverage(0, 4) * outer.said.sum(0)).sum() / max(outer.said.sum(), 1)
    missed, early = out.missed.mean(), (out.at < 0.7).mean()
    values = [
        (spread(c95), bool(np.all((c95 >= 0.92) & (c95 <= 0.98)))),
        (spread(c80), bool(np.all((c80 >= 0.76) & (c80 <= 0.84)))),
        (f"{ratio:.2f}", bool(ratio <= 0.7)),
        ("not measured", None) if np.isnan(beside) else (f"{beside:.2f}", bool(beside <= 1)),
        ("not measured" if np.isnan(told_more) else f"{told_more:.2f}", None),
        (spread(late), bool(np.all(late >= 0.85))),
        (f"{100 * missed:.1f} %", bool(missed <= 0.005)),
        (f"{100 * early:.1f} %", bool(early <= 0.05)),
        (f"{100 * outside:.1f} %", bool(outside > 0.9)),
    ]
    return dict(zip(GOALS, values, strict=True))


def table(ours: Arm, alone: Scores, rivals: Rivals) -> list[str]:
    s, told, known = ours.scores, rivals.population, rivals.watched_known
    rows = [
        ("forecast, % of parts", 100 * (ours.verdicts == "forecast").mean(axis=0), 0),
        ("too early to say", 100 * (ours.verdicts == "too_early").mean(axis=0), 0),
        ("steady", 100 * (ours.verdicts == "steady").mean(axis=0), 0),
        ("95 % interval holds", 100 * s.coverage(0, 4), 1),
        ("the same, alone", 100 * alone.coverage(0, 4), 1),
        ("80 % interval holds", 100 * s.coverage(1, 3), 1),
        ("the same, alone", 100 * alone.coverage(1, 3), 1),
        ("within 20 % (alpha-lambda)", 100 * s.alpha_lambda(), 1),
        ("the same, straight line", 100 * rivals.line.alpha_lambda(), 1),
        ("the same, parts of the oracle", 100 * s.rows(rivals.watched).alpha_lambda(), 1),
        ("the oracle's median, told the population", 100 * told.scores.alpha_lambda(), 1),
        ("the most that can be expected, told the population", 100 * told.best.mean(axis=0), 1),
        ("within 20 %, the oracle's parts of the catalogue's kind", 100 * s.rows(known).alpha_lambda(), 1),
        ("the most, told the law", 100 * rivals.law.best.mean(axis=0), 1),
        ("the most, told law and shape", 100 * rivals.shape.best.mean(axis=0), 1),
        ("relative accuracy, median %", 100 * s.relative_accuracy(), 0),
        ("CRPS", s.crps.mean(axis=0), 3),
        ("CRPS, alone", alone.crps.mean(axis=0), 3),
        ("CRPS, straight line", rivals.line.crps.mean(axis=0), 3),
        ("CRPS, parts of the oracle", s.rows(rivals.watched).crps.mean(axis=0), 3),
        ("CRPS, the oracle told the population", told.scores.crps.mean(axis=0), 3),
        *_progpy_rows(s, rivals),
    ]
    return ["| " + " | ".join([name, *(f"{v:.{digits}f}" for v in values)]) + " |" for name, values, digits in rows]


def _progpy_rows(s: Scores, rivals: Rivals) -> list[tuple[str, np.ndarray, int]]:
    if rivals.progpy_law is None or rivals.progpy_shape is None:
        return []
    return [
        ("CRPS, parts of progpy's comparison", s.rows(rivals.known).crps.mean(axis=0), 3),
        ("CRPS, progpy told the law", rivals.progpy_law.crps.mean(axis=0), 3),
        ("CRPS, progpy told law and shape", rivals.progpy_shape.crps.mean(axis=0), 3),
        ("within 20 %, progpy told the law", 100 * rivals.progpy_law.alpha_lambda(), 1),
        ("95 % interval holds, progpy told the law", 100 * rivals.progpy_law.coverage(0, 4), 1),
    ]


def by_law(s: Scores, laws: Sequence[str]) -> list[str]:
    lines, of = [], np.array(laws)
    for law in sorted(set(laws)):
        own = s.rows(of == law)
        hold = (own.coverage(0, 4) * own.said.sum(0)).sum() / max(own.said.sum(), 1)
        alpha = own.alpha_lambda()
        half, late = alpha[CHECKPOINTS.index(0.5)], alpha[CHECKPOINTS.index(0.8)]
        lines.append(f"| {law} | {len(own.truth)} | {100 * hold:.1f} % | {100 * half:.0f} % | {100 * late:.0f} % |")
    return lines


def removal_line(name: str, r: Removals) -> str:
    used = np.nanmedian(np.minimum(np.where(np.isnan(r.at), 1, r.at), 1))
    return f"| {name} | {100 * r.missed.mean():.1f} % | {100 * (r.at < 0.7).mean():.1f} % | {100 * used:.0f} % |"
