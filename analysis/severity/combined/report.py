"""The page about combined faults: docs/combined.md and a figure for each pair."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lacuna.analysis.severity.combined.study import Study
from lacuna.analysis.severity.robustness import rate
from lacuna.drawn import save

PAGE = """# Two faults at once

Written by `make combined`; do not edit. A map over two faults holds the signature of the pre-flight test, and its
covariance under all other nuisances, on a grid of both severities; a recording then gives both, as a joint posterior
(`lacuna maps --with FAULT`, then `lacuna assess`). Below, {count} simulated tests for each pair: both severities and
all other nuisances uniform over their ranges, sensors as in [robustness.md](robustness.md). *Alone* is the map over
{first} only, on the same recordings.

| {first} together with | {names} |
| --- | {rule} |
{rows}

Errors are root mean squares; that of the other fault is followed by its share of the axis. Friction is a nuisance of
the map alone, from half to double.
"""

SECTION = """
## With {other}, {low} to {high}

![Half widths of the 95 % intervals and correlation](figures/combined_{symbol}.svg)

{verdict}

Between the readings the correlation is at most {correlation:.2f} in magnitude{where}. The 95 % interval of
{first} has a half width of {best:.2f} to {worst:.2f} {unit}.
"""

ROWS = (
    "error of it, {unit}",
    "its 95 % interval holds",
    "error of the other",
    "the other's interval holds",
    "the other is read, of all tests",
    "refused",
    "alone: refused",
    "alone: error where not refused, {unit}",
)


def write_studies(studies: list[Study], docs: Path) -> None:
    from lacuna.analysis.report.figures.style import in_style
    from lacuna.analysis.severity.combined.figures import draw_limits
    from lacuna.written import whole_files

    with whole_files(docs / "figures") as scratch, in_style():
        for study in studies:
            figure = draw_limits(study)
            save(figure, scratch / f"combined_{study.grid.other.symbol}.svg", "svg")
    with whole_files(docs) as scratch:
        (scratch / "combined.md").write_text(page(studies), encoding="utf-8")


def page(studies: list[Study]) -> str:
    fault = studies[0].grid.settings.fault
    columns = [_column(study) for study in studies]
    rows = [
        f"| {name.format(unit=_points(fault.unit))} | {' | '.join(cells)} |"
        for name, *cells in zip(ROWS, *columns, strict=True)
    ]
    head = PAGE.format(
        count=len(studies[0].tests),
        first=fault.name,
        names=" | ".join(study.grid.other.name for study in studies),
        rule=" | ".join("---" for _ in studies),
        rows="\n".join(rows),
    )
    return head + "".join(_section(study) for study in studies)


def _column(study: Study) -> list[str]:
    """Entries of ROWS."""
    fault, other = study.grid.settings.fault, study.grid.other
    read = [test for test in study.tests if test.joint is not None]
    first = np.array([fault.shown(test.joint.first.severity - test.first) for test in read])
    second = np.array([other.shown(test.joint.second.severity - test.second) for test in read])
    holds = [
        np.mean([test.joint.first.low <= test.first <= test.joint.first.high for test in read]),
        np.mean([test.joint.second.low <= test.second <= test.joint.second.high for test in read]),
    ]
    refused = rate(np.array([test.joint is None or not test.joint.covered for test in study.tests]))
    alone = np.array([test.alone is None or not test.alone.covered for test in study.tests])
    taken = [test for test, gone in zip(study.tests, alone, strict=True) if not gone]
    wrong = _rms(np.array([fault.shown(test.alone.severity - test.first) for test in taken])) if taken else np.nan
    axis = other.shown(other.last - other.first)
    return [
        f"{_rms(first):.2f}",
        _percent(holds[0]),
        f"{_rms(second):.3g} {other.unit} ({100 * _rms(second) / axis:.0f} %)",
        _percent(holds[1]),
        _percent(np.mean([test.joint.second.readable for test in read])),
        _percent(refused.value),
        _percent(alone.mean()),
        f"{wrong:.1f}" if taken else "-",
    ]


def _section(study: Study) -> str:
    fault, other, limits = study.grid.settings.fault, study.grid.other, study.limits
    share = limits.readable.mean()
    if share == 1:
        verdict = f"Both are separated everywhere on the map: {other.name} can be read at every severity."
    elif share == 0:
        verdict = (
            f"This test cannot read {other.name} anywhere: its interval spans more than half of the axis (hatched)."
        )
    else:
        name = other.name[0].upper() + other.name[1:]
        verdict = f"{name} can be read on {100 * share:.0f} % of the map; hatched is where not."
    at = np.unravel_index(np.abs(limits.correlation).argmax(), limits.correlation.shape)
    where = f" (at {fault.text(study.grid.x[at[0]])} and {other.text(study.grid.y[at[1]])})"
    half = fault.shown(limits.half_first)
    return SECTION.format(
        other=other.name, symbol=other.symbol, low=f"{other.shown(other.first):.3g}", high=other.text(other.last),
        verdict=verdict, correlation=np.abs(limits.correlation).max(), where=where, first=fault.name,
        best=half.min(), worst=half.max(), unit=_points(fault.unit),
    )  # fmt: skip


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


def _points(unit: str) -> str:
    return "points" if unit == "%" else unit


def _rms(errors: np.ndarray) -> float:
    return float(np.sqrt((errors**2).mean()))
