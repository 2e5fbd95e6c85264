"""report.html of a map: one file, figures inside, for an engineer who does not have this project at hand."""

from __future__ import annotations

from html import escape
from pathlib import Path
from string import Template
from typing import Any

from markupsafe import Markup

from lacuna.analysis.map.plant import Plant, SourceEquation
from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures import FIGURES
from lacuna.analysis.report.figures.style import BAND_FILL, BAND_INK
from lacuna.analysis.report.page import code, figure_in, page
from lacuna.analysis.report.page import table as page_table
from lacuna.analysis.settings import Fault, Settings

_CONSISTENT_SET = """<p class="note"><b>How to read this.</b> The publication gives no motor parameters. The model uses
<em>a consistent set</em>: one that gives the published numbers, fitted in three parameters, and not the only one.
Scaling supply voltage, resistance, inductance, back-EMF constant, inertia and friction by one factor leaves every
current and speed as it is. The agreement shows that the method and the physics fit together; it does not identify the
authors' motor. Spectral lines are to be compared by number, not in hertz: the published ones are rounded.</p>"""

_TEMPLATE = Path(__file__).with_name("map.html.in")


def report_html(plant: Plant, settings: Settings, rows: list[Row], summary: dict[str, Any], folder: Path) -> str:
    """The page; `folder` holds the figures, as draw_all wrote them, and map.csv."""
    first, last, fault = rows[0], rows[-1], settings.fault.name
    verdict = (
        f"{fault[0].upper()}{fault[1:]}: the mean RMS of the phase currents goes from {1e3 * first.rms_mean:.1f} mA at "
        f"{settings.fault.text(first.severity)} to {1e3 * last.rms_mean:.1f} mA at "
        f"{settings.fault.text(last.severity)}."
    )
    action = Markup(
        "read a measured pre-flight test back as a severity: <code>lacuna assess RECORDING --map FOLDER</code>, the "
        "folder of this map"
    )
    body = Markup(_body(plant, settings, rows, summary, folder))
    return page(
        f"Operating map: {settings.title}", body, verdict=verdict, action=action,
        inputs=[folder / "settings.toml"], notes=[f"Model and solver: {plant.hash}"],
    )  # fmt: skip


def _body(plant: Plant, settings: Settings, rows: list[Row], summary: dict[str, Any], folder: Path) -> str:
    return Template(_TEMPLATE.read_text(encoding="utf-8")).substitute(
        model=escape(plant.name),
        count=len(rows),
        first=escape(settings.fault.text(rows[0].severity)),
        last=escape(settings.fault.text(rows[-1].severity)),
        fault=escape(settings.fault.name),
        duration=f"{settings.duration:g}",
        rate=f"{settings.sampling_rate / 1e3:g}",
        sections=_sections(settings),
        peak=_peak_rule(settings),
        speed_after=f"{settings.speed_after:g}",
        test=escape(settings.raw["actuator"].get("test", "as the model has it")),
        comparison=_comparison(summary["comparison"]),
        bands=_bands(summary["bands"], settings.fault),
        figures="\n".join(_figure(stem, folder) for stem in FIGURES),
        solver=escape(settings.solver.upper()),
        tolerances=f"{settings.relative_tolerance:g} relative, {settings.absolute_tolerance:g} absolute",
        counters=_counters(summary["counters"], len(rows)),
        equations=_equations(plant.equations),
        settings=escape(settings.text),
    )


def _table(header: list[str], rows: list[list[str]], number_columns: range = range(1, 99)) -> str:
    """Cells are HTML already."""
    return page_table([Markup(h) for h in header], ([Markup(c) for c in row] for row in rows), number_columns)


_DIGITS = {"mA": ".1f", "Hz": ".3f", "%": ".0f"}


def _value(value: Any, unit: str, sign: str = "") -> str:
    if value is None:
        return "none"
    text = format(value, sign + _DIGITS[unit]) if unit in _DIGITS and isinstance(value, float) else str(value)
    return escape(f"{text} {unit}" if unit not in ("", "line") else text)


def _published(value: Any, unit: str) -> str:
    """With the digits that were published."""
    return _value(f"{value:.12g}" if isinstance(value, float) else value, unit)


def _comparison(comparison: list[dict[str, Any]]) -> str:
    if not comparison:
        return ""
    rows = []
    for entry in comparison:
        published, found, unit = entry["published"], entry["reproduced"], entry["unit"]
        if isinstance(published, float) and isinstance(found, float):
            difference = _value(found - published, unit, "+")
        else:
            difference = "same" if published == found else "differs"
        name = escape(entry["quantity"] + (" (spectral line)" if unit == "line" else ""))
        rows.append([name, _published(published, unit), _value(found, unit), difference])
    table = _table(["quantity", "published", "reproduced", "difference"], rows)
    return f"<h2>Published and reproduced</h2>\n{table}\n{_CONSISTENT_SET}"


def _bands(bands: list[dict[str, Any]], fault: Fault) -> str:
    rows = [
        [
            f'<span class="band" style="background:{BAND_FILL.get(b["name"], "#eee")};'
            f'color:{BAND_INK.get(b["name"], "#333")}">{escape(b["name"])}</span>',
            escape(b["mode"]),
            escape(f"{fault.text(b['first'])} to {fault.text(b['last'])}"),
            f"{1e3 * b['rms_first']:.1f} to {1e3 * b['rms_last']:.1f} mA",
            f"{1e3 * b['rise']:.1f} mA",
        ]
        for b in bands
    ]
    return _table(["band", "mode", "severity", "mean RMS", "rise"], rows, range(2, 5))


def _figure(stem: str, folder: Path) -> str:
    title, caption, _ = FIGURES[stem]
    return figure_in(folder, stem, title, caption)


def _sections(settings: Settings) -> str:
    spectrum = settings.raw["spectrum"]
    padding = {
        "record": "zero-padded to the next power of two of the whole record",
        "section": "zero-padded to the next power of two of a section",
        "none": "not padded",
    }[spectrum["padding"]]
    return (
        f"sections of {100 * spectrum['section']:g} % of the record, overlapping by {100 * spectrum['overlap']:g} %, "
        f"each with a Hann window and {padding}"
    )


def _peak_rule(settings: Settings) -> str:
    rule = settings.raw["first_peak"]
    share = 100 * rule["threshold"]
    return f"the first local maximum above {rule['above']:g} Hz that exceeds {share:g} % of the largest line"


def _counters(counters: dict[str, int], runs: int) -> str:
    rows = [[escape(name.replace("_", " ")), f"{total:,}", f"{total / runs:,.1f}"] for name, total in counters.items()]
    return _table(["solver counter", "all runs", "each run"], rows)


def _equations(equations: list[SourceEquation]) -> str:
    """Equations as written in the model, by component; components with the same equations share one list."""
    if not equations:
        return "<p>This plant is not a translated model; it has no equations to show.</p>"
    parts: dict[str, list[SourceEquation]] = {}
    for equation in equations:
        parts.setdefault(equation.origin or "model", []).append(equation)
    alike: dict[str, list[str]] = {}
    for origin, members in parts.items():
        lines = "\n".join(f"<i>{escape(e.place):<24}</i>{escape(e.text)}" for e in members)
        alike.setdefault(lines, []).append(origin)
    return "\n".join(
        f"<h4>{escape(', '.join(names))}</h4>{code(Markup(lines), 'equations')}" for lines, names in alike.items()
    )
