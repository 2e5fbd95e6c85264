"""Files of a forecast: forecast.json, a fan chart for each actuator, and a report of one page."""

from __future__ import annotations

from collections.abc import Sequence
import io
from itertools import count
import json
from pathlib import Path
import re

from markupsafe import Markup
import numpy as np

from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.filter.crossing import remaining
from lacuna.analysis.prognosis.filter.filter import run
from lacuna.analysis.prognosis.filter.smoother import tracked
from lacuna.analysis.prognosis.forecast import LEVELS as PROBABILITIES
from lacuna.analysis.prognosis.forecast import Forecast
from lacuna.analysis.prognosis.pages.figure import LEVELS, draw
from lacuna.analysis.prognosis.pages.telling import (
    Advice,
    counted_verdicts,
    forecast_json,
    removals,
    sentence,
    urgency,
    use,
    whom,
)
from lacuna.analysis.prognosis.series import last_error, series_of
from lacuna.analysis.prognosis.verdict import BEYOND, FORECAST
from lacuna.analysis.report.page import figure, heading, page, table
from lacuna.drawn import save
from lacuna.written import whole_files

MOST_LETTERS = 50  # of a file's name: file systems allow some 250 bytes, and a letter may take four of UTF-8's
_TRACKED = "Points: the severity that each test showed, with its 95 % interval. Line: the severity tracked over them."
_FAN = (
    f"{_TRACKED} Fan: when each severity will be reached; the grey line is the last test, the red one the last that is "
    "advised."
)
DRAWN = 40  # actuators that get a figure; of more, those at greatest risk


def publish(
    said: Sequence[Forecast], bank: Bank, out: Path, risk: float, version: str, inputs: Sequence[Path] = ()
) -> None:
    """Write forecast.json, report.html and figures into `out`, together or not at all; `inputs` are files that were
    read."""
    from lacuna.analysis.report.figures.data import drawn_data
    from lacuna.analysis.report.figures.style import in_style, new_figure

    first = sorted(said, key=urgency)[:DRAWN]
    parts, taken = [], set[str]()
    with whole_files(out) as scratch, in_style():
        text = json.dumps(forecast_json(said, risk, version), indent=2, ensure_ascii=False, allow_nan=False)
        (scratch / "forecast.json").write_text(text + "\n", encoding="utf-8")
        for f in first:
            drawn = new_figure()
            draw(drawn.add_subplot(), f, *curves(f, bank))
            name = _file_name(f, taken)
            drawn.axes[0].set_title(f.history.actuator)
            save(drawn, scratch / f"{name}.png", "png")
            drawn.axes[0].set_title("")  # the page has the name, escaped
            picture = io.StringIO()
            save(drawn, picture, "svg")
            parts.append(_part(f, picture.getvalue(), (f"{name}.csv", drawn_data(drawn)), risk))
        shown = f"{len(first)} of {len(said)} shown, those at greatest risk first." if len(said) > DRAWN else ""
        limits = dict.fromkeys(f"Limits{f' of {f.history.fault}' * bool(f.history.fault)}: {_begins(f)}." for f in said)
        notes = ["Intervals are of remaining use; the fan shows when each severity is reached.", *limits]
        advised = [
            Advice(whom(f.history.actuator, f.history.fault), f.advised, f.at, f.history.unit)
            for f in said if f.verdict == FORECAST
        ]  # fmt: skip
        beyond = [whom(f.history.actuator, f.history.fault) for f in said if BEYOND in f.warnings]
        verdict, action = removals(advised, len(said), beyond, said[0].limits.names[-1] if said else "", risk)
        counted = f"{counted_verdicts(said)} {shown}".strip()
        whole = page(
            "Flights that remain", Markup("").join(parts), verdict=f"{verdict} {counted}", action=action,
            notes=notes, inputs=inputs,
        )  # fmt: skip
        (scratch / "report.html").write_text(whole, encoding="utf-8")


def _begins(f: Forecast) -> str:
    return ", ".join(f"{n} from {f.limits.text(v)}" for n, v in zip(f.limits.names, f.limits.values, strict=True))


def _file_name(f: Forecast, taken: set[str]) -> str:
    """Of the figures of an actuator: letters, digits and what is safe in a name; numbered where two would share one."""
    plain = re.sub(r"[^\w.-]", "_", f"{f.history.actuator}_{f.history.fault}".rstrip("_"))[:MOST_LETTERS]
    name = next(n for k in count(1) if (n := plain if k == 1 else f"{plain}_{k}").casefold() not in taken)
    taken.add(name.casefold())
    return name


def _part(f: Forecast, svg: str, data: tuple[str, str], risk: float) -> Markup:
    said = sentence(f, risk)
    parts = [
        heading(said),
        *(Markup("<p class=warn>{}</p>").format(w) for w in f.warnings),
        figure(svg, said, _FAN if f.verdict == FORECAST else _TRACKED, data),
    ]
    if f.verdict == FORECAST:
        unit = f.history.unit
        header = [f"{unit} until it", "95 % sure: from", "80 % sure: from", "median", "80 % sure: to", "95 % sure: to"]
        rows = [[name, *_cells(row)] for name, row in zip(f.limits.names, f.quantiles, strict=True)]
        laws = ", ".join(f"{n} {100 * w:.0f} %" for n, w in list(f.weights.items())[:3])
        parts += [table(header, rows), Markup("<p><small>Laws of growth, by probability: {}.</small></p>").format(laws)]
    return Markup("").join(parts)


def _cells(row: np.ndarray) -> list[str]:
    """Of a limit that is behind, that it is."""
    if np.all(row <= 0):
        return ["reached", *[""] * (len(row) - 1)]
    return [use(value) if np.isfinite(value) else "-" for value in row]


def curves(f: Forecast, bank: Bank):
    """(smoothed, levels) for `figure.draw`: what the tests say of the past, and when each severity is reached."""
    limit, healthy = f.limits.span, f.limits.healthy
    series = series_of([f.history], limit, bank, healthy)
    steps = list(run(bank, series, keep=True))
    mean, deviation = tracked(bank, steps)
    part = f.history.lives[-1]
    smoothed = (f.history.use[part], healthy + mean[:, 0] * limit, deviation[:, 0] * limit)
    if f.verdict != FORECAST or mean[-1, 0] >= 1:
        return smoothed, None
    shares = np.linspace(min(mean[-1, 0], 0.99), 1.1, LEVELS)
    error = np.array([last_error(series, 0)])
    last = steps[-1].filtered
    quantiles = [
        remaining(bank, last, s, error, series.interval).quantiles(PROBABILITIES, np.array([10 * f.horizon]))[0]
        for s in shares
    ]
    return smoothed, (healthy + shares * limit, np.array(quantiles))
