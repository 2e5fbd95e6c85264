"""report.html of a sweep: how many tests ran, what failed and why, and the mean RMS over the fault of every test."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
import io
from pathlib import Path

from markupsafe import Markup
from matplotlib.figure import Figure
import numpy as np
import pyarrow as pa

from lacuna.analysis.report.figures.style import in_style, new_figure
from lacuna.analysis.report.page import figure, heading, page, paragraph, table
from lacuna.analysis.settings import Settings
from lacuna.drawn import save
from lacuna.written import write_whole

SHOWN = 4000  # points of the figure and of its data; beyond, every n-th test (the sequence fills the range evenly)


def report_html(results: pa.Table, model: str, settings: Settings, units: Mapping[str, str]) -> str:
    """The page, of a table as `run_campaign` gives it; `units` of the model's variables."""
    failures = Counter(text for text in results["failure"].to_pylist() if text is not None)
    failed = sum(failures.values())
    body = [
        _cloud(results, settings),
        heading("What was drawn at random, and what was read of it"),
        _ranges(results, units),
    ]
    if failures:
        body += [heading("What failed"), table(("why", "tests"), failures.most_common())]
    body += [paragraph("results.parquet has one row a test: parameters, features, and why a test failed.")]
    name = model.rsplit(".", 1)[-1]
    verdict = f"{len(results) - failed} of {len(results)} tests of {name} were simulated and analysed."
    action = (
        f"see below why {failed} are missing"
        if failed
        else "read results.parquet: a row for each test, with what was drawn for it and what was read of it"
    )
    notes = [f"Model: {model}"]
    body_text = Markup("\n").join(body)
    return page(f"Sweep: {name}", body_text, verdict=verdict, action=action, inputs=[settings.path], notes=notes)


def _column(results: pa.Table, name: str) -> np.ndarray:
    return np.asarray(results[name].to_numpy(), dtype=float)


def _cloud(results: pa.Table, settings: Settings) -> Markup:
    fault = settings.fault
    every = slice(None, None, -(-len(results) // SHOWN))
    severity, rms = (_column(results, name)[every] for name in (fault.parameter, "rms_mean"))
    with in_style():
        drawn: Figure = new_figure()
        axes = drawn.subplots()
        axes.plot(fault.scale * severity, 1e3 * rms, ".", markersize=9 if severity.size < 200 else 3)
        axes.set_xlabel(f"{fault.name}  ({fault.unit})")
        axes.set_ylabel("mean RMS of the phase currents  (mA)")
        buffer = io.StringIO()
        save(drawn, buffer, "svg")
    data = f"{fault.symbol},rms_mean\n" + "".join(f"{x:.9g},{y:.9g}\n" for x, y in zip(severity, rms, strict=True))
    caption = f"One point a test, {len(severity)} of {len(results)}: what the nuisances do to the reading of the fault."
    return figure(buffer.getvalue(), "Mean RMS over the fault, one point a test", caption, ("sweep.csv", data))


def _ranges(results: pa.Table, units: Mapping[str, str]) -> Markup:
    names = [name for name in results.column_names if name != "failure" and results[name].type == pa.float64()]
    rows = []
    for name in names:
        values = _column(results, name)
        values = values[np.isfinite(values)]
        if values.size:
            unit = units.get(name) or _unit(name)
            rows.append((name, unit, *(f"{v:.5g}" for v in (values.min(), np.median(values), values.max()))))
    return table(("column", "unit", "least", "median", "greatest"), rows, numbers=range(2, 5))


def _unit(name: str) -> str:
    """Of a feature."""
    found = [unit for head, unit in (("rms_", "A"), ("peak_hz", "Hz"), ("speed_", "rad/s")) if name.startswith(head)]
    return found[0] if found else ""


def write(results: Path, model: str, settings: Settings, units: Mapping[str, str]) -> Path:
    """Write the page beside results.parquet."""
    import pyarrow.parquet as pq

    path = results.with_name("report.html")
    write_whole(path, report_html(pq.read_table(results), model, settings, units))
    return path
