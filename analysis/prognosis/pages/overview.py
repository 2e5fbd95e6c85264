"""The overview of a fleet: one page, everything inside, to be pinned to a wall."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import csv
from html import escape
import io
import math
from pathlib import Path

from markupsafe import Markup
import pyarrow as pa

from lacuna.analysis.prognosis.forecast import Limits
from lacuna.analysis.prognosis.pages.telling import Advice, removals, use, whom
from lacuna.analysis.prognosis.verdict import BEYOND
from lacuna.analysis.report.page import figure, page

SHOWN = 60  # actuators at greatest risk
MARGIN = 30  # at the right, for half of the last number
WIDTH, ROW, FONT = 720, 20, 13  # of the drawing: its text can be read where it is as narrow as figures get

_COUNTS = Markup("""<p class="counts"><span><b>{total}</b> actuators</span> <span><b>{now}</b> remove now</span>
<span><b>{forecast}</b> with a forecast</span> <span><b>{early}</b> too early to say</span>
<span><b>{steady}</b> steady</span></p>""")
_ABOVE = Markup(
    "<p>{shown} at greatest risk, with their severity: use that remains to {limit} (median, 80 % and 95 % intervals), "
    "and the last advised test (red dot; at zero: remove now). An arrow at the right: the median lies beyond the axis; "
    "a bar that ends there goes on.</p>"
)


def overview(
    table: pa.Table, limits: Mapping[str, Limits], title: str = "Fleet", inputs: Sequence[Path] = (),
    risk: float | None = None,
) -> str:  # fmt: skip
    """The page, of a table as `run_fleet` gives it; `limits` by fault, `inputs` the files that were read, `risk`
    that of the last limit which is taken."""
    rows = table.slice(0, SHOWN).to_pylist()
    first = [r for r in rows if r["verdict"] == "forecast"]
    verdicts = table["verdict"].to_pylist()
    names = ("actuator", "fault", "advised_last_test", "at", "unit", "verdict")
    columns = zip(*(table[name].to_pylist() for name in names), strict=True)
    advised = [Advice(whom(a, fault), last, at, unit) for a, fault, last, at, unit, v in columns if v == "forecast"]
    warned = zip(*(table[name].to_pylist() for name in ("actuator", "fault", "warnings")), strict=True)
    beyond = [whom(a, fault) for a, fault, warnings in warned if BEYOND in (warnings or "")]
    verdict, action = removals(advised, len(table), beyond, next(iter(limits.values())).names[-1], risk)
    counts = _COUNTS.format(
        total=len(table), now=verdict.split(" ", 1)[0], forecast=verdicts.count("forecast"),
        early=verdicts.count("too_early"), steady=verdicts.count("steady"),
    )  # fmt: skip
    parts = [counts]
    if first:
        parts += [
            _ABOVE.format(shown=len(first), limit=next(iter(limits.values())).names[-1]),
            figure(_drawing(first, limits), "Use that remains, by actuator", data=("fleet.csv", _data(first))),
        ]
    notes = ["The whole table is in fleet.parquet."]
    return page(title, Markup("").join(parts), verdict=verdict, action=action, notes=notes, inputs=inputs)


def _data(rows: list[dict]) -> str:
    """What the drawing shows, as CSV."""
    names = ["actuator", "fault", "severity", "median", "low80", "high80", "low95", "high95"]
    names += ["at", "advised_last_test", "unit"]
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerows([names, *([row[name] for name in names] for row in rows)])
    return text.getvalue()


def _round(value: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is not above `value`."""
    power = 10 ** math.floor(math.log10(value))
    return max(m * power for m in (1, 2, 5) if m * power <= value)


def _drawing(rows: list[dict], limits: Mapping[str, Limits]) -> str:
    """A bar for each actuator, by remaining use; what is beyond the axis runs out of it."""
    ends = sorted(r["high80"] if r["high80"] is not None else r["median"] or 0 for r in rows)
    top = max(ends[math.ceil(0.9 * (len(ends) - 1))], 1e-12) * 1.1  # few of the longest lives run out of it
    left, height = 190, ROW * (len(rows) + 2)
    step = _round(top / 4)

    def at(left_over: float | None) -> float:
        return left + (WIDTH - MARGIN - left) * min(1.0, (top if left_over is None else left_over) / top)

    def mark(left_over: float, y: float, inside: str, colour: str) -> str:
        """`inside` where the axis reaches as far, else an arrow at its end."""
        if left_over <= top:
            return f'<{inside} fill="{colour}"/>'
        x = WIDTH - MARGIN
        return f'<path d="M{x} {y - 5:.1f}l8 5-8 5z" fill="{colour}"/>'

    parts = [f'<svg viewBox="0 0 {WIDTH} {height}" font-size="{FONT}" font-family="system-ui,sans-serif">']
    for k in range(int(top / step) + 1):
        x = at(k * step)
        parts.append(f'<path d="M{x:.1f} 0V{height - ROW}" stroke="#ddd"/><text x="{x:.1f}" y="{height - 4}"'
                     f' text-anchor="middle">{use(k * step)}</text>')  # fmt: skip
    parts.append(f'<text x="{left - 8}" y="{height - 4}" text-anchor="end">{escape(rows[0]["unit"])}</text>')
    for k, r in enumerate(rows):
        y = ROW * (k + 0.5) + 4
        name = escape(f"{whom(r['actuator'], r['fault'])}, {limits[r['fault']].text(r['severity'])}")
        parts.append(f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{name}</text>')
        for low, high, colour in (("low95", "high95", "#c9d8e8"), ("low80", "high80", "#6f9cc6")):
            x, end = at(r[low]), at(r[high])
            parts.append(
                f'<rect x="{x:.1f}" y="{y - 5:.1f}" width="{max(end - x, 1):.1f}" height="10" fill="{colour}"/>'
            )
        median = math.inf if r["median"] is None else r["median"]
        bar = f'rect x="{at(r["median"]):.1f}" y="{y - 6:.1f}" width="2" height="12"'
        parts.append(mark(median, y, bar, "#0b3d6b"))
        if r["advised_last_test"] is not None:
            last = r["advised_last_test"] - r["at"]
            parts.append(mark(last, y, f'circle cx="{at(last):.1f}" cy="{y:.1f}" r="4"', "#b3261e"))
    return "".join([*parts, "</svg>"])
