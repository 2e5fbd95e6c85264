"""docs/prognosis.md: what was measured, beside what was aimed at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

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

*What can be reached*: the same filter, told each part's law and shape, its process noise and the fleet's lives, is
within 20 % for {bound_law} of the parts of the catalogue's kind from half of life on; told the ten laws of the
population but not which of them a part has, for {bound_population} of all parts. The rest is what tests and process
noise leave open.

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
class Bounds:
    """What bounds.py measured: told the law on the parts `known`, told the population on all."""

    known: np.ndarray
    law: Scores
    population: Scores


def spread(values: np.ndarray) -> str:
    return f"{100 * values.min():.1f} to {100 * values.max():.1f} %"


def goals(
    arms: Sequence[Arm], line: Scores, known: np.ndarray, progpy: Scores | None, unknown: np.ndarray
) -> list[str]:
    """The lines of the goals: each with what every arm measured, and whether it is met."""
    columns = [_measured(arm, line, known, progpy, unknown) for arm in arms]
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
    "within 20 % from half of life on": "at least 85 %",
    "missed removals": "at most 0.5 %",
    "removals before 70 % of life": "at most 5 %",
    "95 % interval holds, laws outside the catalogue": "above 90 %",
}


def _measured(arm: Arm, line: Scores, known, progpy: Scores | None, unknown) -> dict[str, tuple[str, bool | None]]:
    s, out = arm.scores, arm.removals
    c95, c80 = s.coverage(0, 4), s.coverage(1, 3)
    late = s.alpha_lambda()[LATE]
    ratio = s.crps.mean() / line.crps.mean()
    beside = s.rows(known).crps.mean() / progpy.crps.mean() if progpy is not None else np.nan
    outer = s.rows(unknown)
    outside = (outer.coverage(0, 4) * outer.said.sum(0)).sum() / max(outer.said.sum(), 1)
    missed, early = out.missed.mean(), (out.at < 0.7).mean()
    values = [
        (spread(c95), bool(np.all((c95 >= 0.92) & (c95 <= 0.98)))),
        (spread(c80), bool(np.all((c80 >= 0.76) & (c80 <= 0.84)))),
        (f"{ratio:.2f}", bool(ratio <= 0.7)),
        ("not measured", None) if progpy is None else (f"{beside:.2f}", bool(beside <= 1)),
        (spread(late), bool(np.all(late >= 0.85))),
        (f"{100 * missed:.1f} %", bool(missed <= 0.005)),
        (f"{100 * early:.1f} %", bool(early <= 0.05)),
        (f"{100 * outside:.1f} %", bool(outside > 0.9)),
    ]
    return dict(zip(GOALS, values, strict=True))


def table(ours: Arm, alone: Scores, line: Scores, told: Bounds, progpy: Scores | None, known: np.ndarray) -> list[str]:
    s = ours.scores
    rows = [
        ("forecast, % of parts", 100 * (ours.verdicts == "forecast").mean(axis=0), 0),
        ("too early to say", 100 * (ours.verdicts == "too_early").mean(axis=0), 0),
        ("steady", 100 * (ours.verdicts == "steady").mean(axis=0), 0),
        ("95 % interval holds", 100 * s.coverage(0, 4), 1),
        ("the same, alone", 100 * alone.coverage(0, 4), 1),
        ("80 % interval holds", 100 * s.coverage(1, 3), 1),
        ("the same, alone", 100 * alone.coverage(1, 3), 1),
        ("within 20 % (alpha-lambda)", 100 * s.alpha_lambda(), 1),
        ("the same, straight line", 100 * line.alpha_lambda(), 1),
        ("the same, told the population", 100 * told.population.alpha_lambda(), 1),
        ("within 20 %, laws of the catalogue's kind", 100 * s.rows(told.known).alpha_lambda(), 1),
        ("the same, told the law", 100 * told.law.alpha_lambda(), 1),
        ("relative accuracy, median %", 100 * s.relative_accuracy(), 0),
        ("CRPS", s.crps.mean(axis=0), 3),
        ("CRPS, alone", alone.crps.mean(axis=0), 3),
        ("CRPS, told the population", told.population.crps.mean(axis=0), 3),
        ("CRPS, laws of the catalogue's kind", s.rows(told.known).crps.mean(axis=0), 3),
        ("CRPS, the same told the law", told.law.crps.mean(axis=0), 3),
        ("CRPS, straight line", line.crps.mean(axis=0), 3),
    ]
    if progpy is not None:
        rows += [
            ("CRPS, parts of progpy's comparison", s.rows(known).crps.mean(axis=0), 3),
            ("CRPS, progpy told the law", progpy.crps.mean(axis=0), 3),
            ("95 % interval holds, progpy", 100 * progpy.coverage(0, 4), 1),
        ]
    return ["| " + " | ".join([name, *(f"{v:.{digits}f}" for v in values)]) + " |" for name, values, digits in rows]


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
