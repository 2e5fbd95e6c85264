"""docs/prognosis.md: what was measured, beside what was aimed at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bench.prognosis.scores import CHECKPOINTS, Scores
from bench.prognosis.study import Removals

PAGE = """# Prognosis, measured

Written by `make prognosis` (seed {seed}, version {version}); do not edit. {count} parts, each with a life by a law drawn from six
that are much like the catalogue's and four that it lacks ({outside} parts: slow start, knee, seasons, shocks), with a wandering
rate, written in `bench/prognosis/` without a line of the filter. Tests come at irregular intervals, 20 to 120 a life; 5 % are
missing, 2 % outliers, a tenth of the parts follows another one. Each test is read as a simulated pre-flight test of
[robustness.md](robustness.md) was read, its friction and inertia those of the actuator for life. Forecasts are made at every tenth
of life, with what is known then. Seeds, scores and goals were committed before the first run. How it is done: [forecast.md](forecast.md).

## Goals

| | goal | measured | |
| --- | --- | --- | --- |
{goals}

*Forecast* is what the command says for the whole fleet, whose own prior is learnt from the histories as far as they go at that
tenth of life; *alone* is every actuator by itself.

## By share of life

| share of life | {shares} |
| --- | {dashes} |
{table}

Alpha-lambda counts every part: one that is not forecast is not within 20 %. CRPS is the mean over all parts, in lives.

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


@dataclass(frozen=True)
class Row:
    text: str
    goal: str
    measured: str
    met: bool | None

    def line(self) -> str:
        mark = {True: "met", False: "**missed**", None: "not measured"}[self.met]
        return f"| {self.text} | {self.goal} | {self.measured} | {mark} |"


def percent(values) -> str:
    return " ".join(f"{100 * v:.1f}" for v in np.atleast_1d(values))


def spread(values: np.ndarray) -> str:
    return f"{100 * values.min():.1f} to {100 * values.max():.1f} %"


def goals(s: Scores, line: Scores, ours_known: Scores | None, progpy: Scores | None, unknown: Scores, out: Removals):
    """The lines of "It must show" that the study measures."""
    c95, c80, alpha = s.coverage(0, 4), s.coverage(1, 3), s.alpha_lambda()
    ratio = s.crps.mean() / line.crps.mean()
    beside = ours_known.crps.mean() / progpy.crps.mean() if progpy is not None else None
    late = [CHECKPOINTS[k] >= 0.5 for k in range(len(CHECKPOINTS))]
    outside = (unknown.coverage(0, 4) * unknown.said.sum(0)).sum() / max(unknown.said.sum(), 1)
    missed, early = out.missed.mean(), (out.at < 0.7).mean()
    return [
        Row("95 % interval holds, every tenth from 30 %", "92 to 98 %", spread(c95), bool(np.all((c95 >= 0.92) & (c95 <= 0.98)))),
        Row("80 % interval holds", "76 to 84 %", spread(c80), bool(np.all((c80 >= 0.76) & (c80 <= 0.84)))),
        Row("CRPS over that of a straight line", "at most 0.7", f"{ratio:.2f}", bool(ratio <= 0.7)),
        Row("CRPS over that of progpy told the law", "at most 1.0", "-" if beside is None else f"{beside:.2f}",
            None if beside is None else bool(beside <= 1)),
        Row("within 20 % from half of life on", "at least 85 %", spread(alpha[late]), bool(np.all(alpha[late] >= 0.85))),
        Row("missed removals", "at most 0.5 %", f"{100 * missed:.1f} %", bool(missed <= 0.005)),
        Row("removals before 70 % of life", "at most 5 %", f"{100 * early:.1f} %", bool(early <= 0.05)),
        Row("95 % interval holds, laws outside the catalogue", "above 90 %", f"{100 * outside:.1f} %", bool(outside > 0.9)),
    ]  # fmt: skip


def table(s: Scores, alone: Scores, line: Scores, verdicts: dict[str, list[int]], progpy: Scores | None, known) -> list[str]:
    n = len(s.truth)
    rows = [
        ("forecast, % of parts", [100 * v / n for v in verdicts["forecast"]], 0),
        ("too early to say", [100 * v / n for v in verdicts["too_early"]], 0),
        ("steady", [100 * v / n for v in verdicts["steady"]], 0),
        ("95 % interval holds", 100 * s.coverage(0, 4), 1),
        ("the same, alone", 100 * alone.coverage(0, 4), 1),
        ("80 % interval holds", 100 * s.coverage(1, 3), 1),
        ("the same, alone", 100 * alone.coverage(1, 3), 1),
        ("within 20 % (alpha-lambda)", 100 * s.alpha_lambda(), 1),
        ("the same, straight line", 100 * line.alpha_lambda(), 1),
        ("relative accuracy, median %", 100 * s.relative_accuracy(), 0),
        ("CRPS", s.crps.mean(axis=0), 3),
        ("CRPS, alone", alone.crps.mean(axis=0), 3),
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
