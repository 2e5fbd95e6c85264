"""The page and the figure of a robustness study."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from lacuna.analysis.settings import Settings
from lacuna.analysis.severity.robustness import Rate, Results, error_shares, rate, roc
from lacuna.drawn import save

PAGE = """# Robustness of the severity estimate

Written by `make robustness`; do not edit. {count} simulated pre-flight tests of `{model}`: severity
uniform over the map, and at the same time every nuisance below uniform over its range, with gain, offset and noise on
each channel and a 12-bit converter. Simulated with {solver}, assessed as `lacuna assess` does. The map is
that of `{map_model}`. Tests and severity table come from one model: what it lacks of a real actuator is
not measured here.

Two methods read the same recordings:

- **mean RMS**: the paper's own, the mean RMS read back on the map;
- **signature**: RMS, fundamental, direct component and harmonics of each phase and the frequency, by generalised least
  squares with the covariance that the nuisances give them, at several levels of friction.

| | mean RMS | signature |
| --- | --- | --- |
{methods}

*Needs maintenance* is a severity of {threshold} and above. By the mean RMS it is said where the reading is above the
middle of the gap before the red band; by the signature where the 95 % interval reaches {threshold}, because an alarm
near the threshold costs less than a missed rotor. Brackets: 95 % intervals of the shares.

![Readings and receiver operating characteristic](figures/robustness.svg)

## Which nuisance hurts

Share of the error's variance that each nuisance's own value explains; what is missing to 100 % is their interplay, the
sensors, and the severity.

| nuisance | mean RMS | signature |
| --- | --- | --- |
{nuisances}

The transducer's offset moves nothing: the position loop is saturated, and asks for full voltage whatever it reads.

## By severity

| true severity | tests | mean RMS: error | signature: error | interval holds | refused |
| --- | --- | --- | --- | --- | --- |
{bins}

Errors are root mean squares in {unit} of severity. *Refused* are recordings that the map explains at no severity;
they are counted in every number above as if they had been read.

## Actuators that are not the map's

{per_stranger} tests of each, under the same nuisances. Refused or warned of is what lies off the map by more than the
nuisances explain; what is left is read as if it were the map's actuator, with the error of the last column.

| actuator | refused | warned of | read without a word | error of those |
| --- | --- | --- | --- | --- |
{strangers}

Of the map's own actuator {own_refused} were refused and {own_warned} read with a warning.
"""


Strangers = list[tuple[str, Results]]  # by name


def write_study(settings: Settings, results: Results, strangers: Strangers, docs: Path) -> None:
    """docs/robustness.md and docs/figures/robustness.svg."""
    from lacuna.analysis.report.figures.robustness import draw
    from lacuna.analysis.report.figures.style import in_style
    from lacuna.written import whole_files

    with whole_files(docs / "figures") as scratch, in_style():
        figure = draw(settings, results)
        save(figure, scratch / "robustness.svg", "svg")
    with whole_files(docs) as scratch:
        (scratch / "robustness.md").write_text(page(settings, results, strangers), encoding="utf-8")


def page(settings: Settings, results: Results, strangers: Strangers) -> str:
    fault, threshold = settings.fault, settings.table("assessment")["maintenance"]
    ours, paper = results.estimate - results.severity, results.paper - results.severity
    nuisances = [
        f"| {nuisance['name']} | {_percent(a)} | {_percent(b)} |"
        for nuisance, a, b in zip(
            settings.nuisances, error_shares(results, paper), error_shares(results, ours), strict=True
        )
    ]
    return PAGE.format(
        count=len(results.severity),
        model=settings.disturbed_model,
        map_model=settings.model,
        solver=settings.table("assessment")["solver"],
        threshold=fault.text(threshold),
        unit="points" if fault.unit == "%" else fault.unit,
        methods="\n".join(_methods(settings, results)),
        nuisances="\n".join(nuisances),
        bins="\n".join(_bins(settings, results, paper, ours)),
        strangers="\n".join(_stranger(settings, *stranger) for stranger in strangers),
        per_stranger=len(strangers[0][1].severity) if strangers else 0,
        own_refused=_rate(rate(~results.covered)),
        own_warned=_rate(rate(results.warned)),
    )


def alarms(settings: Settings, results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Who says "needs maintenance": (mean RMS, signature)."""
    threshold = settings.table("assessment")["maintenance"]
    before = max((band.last for band in settings.bands if band.last < threshold), default=threshold)
    return results.paper >= (before + threshold) / 2, results.high >= threshold


def _methods(settings: Settings, results: Results) -> list[str]:
    fault, threshold = settings.fault, settings.table("assessment")["maintenance"]
    sick, healthy = results.severity >= threshold, results.severity < settings.bands[0].last
    by_paper, by_ours = alarms(settings, results)
    readings = (results.paper, results.estimate)
    errors = [fault.shown(reading - results.severity) for reading in readings]
    areas = [roc(sick, reading)[2] for reading in readings]
    holds = rate((results.low <= results.severity) & (results.severity <= results.high))
    rows = [
        ("severity error, root mean square", *(f"{np.sqrt((e**2).mean()):.2f}" for e in errors)),
        ("severity error, mean", *(f"{e.mean():+.2f}" for e in errors)),
        ("severity error, largest", *(f"{np.abs(e).max():.1f}" for e in errors)),
        (f"missed, at {fault.text(threshold)} and above", *(_rate(rate(~a[sick])) for a in (by_paper, by_ours))),
        (
            f"false alarms, below {fault.text(settings.bands[0].last)}",
            *(_rate(rate(a[healthy])) for a in (by_paper, by_ours)),
        ),
        ("area under the ROC", *(f"{area:.4f}" for area in areas)),
        ("95 % interval holds the truth", "none given", _rate(holds)),
        ("refused", "never", _rate(rate(~results.covered))),
    ]
    return [f"| {name} | {a} | {b} |" for name, a, b in rows]


def _bins(settings: Settings, results: Results, paper: np.ndarray, ours: np.ndarray) -> list[str]:
    fault, lines = settings.fault, []
    edges = np.linspace(fault.first, fault.last, 6)
    for first, last in pairwise(edges):
        within = (results.severity >= first) & (results.severity < last)
        holds = (results.low <= results.severity) & (results.severity <= results.high)
        a, b = (fault.shown(np.sqrt((e[within] ** 2).mean())) for e in (paper, ours))
        lines.append(
            f"| {fault.shown(first):g} to {fault.text(last)} | {within.sum()} | {a:.2f} | {b:.2f} "
            f"| {_percent(holds[within].mean())} | {_percent((~results.covered[within]).mean())} |"
        )
    return lines


def _stranger(settings: Settings, name: str, results: Results) -> str:
    silent = results.covered & ~results.warned
    errors = settings.fault.shown(results.estimate - results.severity)[silent]
    error = f"{np.sqrt((errors**2).mean()):.1f}" if silent.any() else "-"
    shares = (~results.covered, results.warned, silent)
    return f"| {name} | {' | '.join(_percent(share.mean()) for share in shares)} | {error} |"


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


def _rate(found: Rate) -> str:
    low, high = found.interval
    return f"{_percent(found.value)} [{100 * low:.1f}, {100 * high:.1f}]"
