"""The two comparisons a user asks for: all scenarios lane against lane, and one model against a file from elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
import csv
from pathlib import Path

import numpy as np

from lacuna import runtime
from lacuna.analysis.comparison.deviation import SignalDeviation, signal_deviation
from lacuna.analysis.comparison.scenarios import Scenario
from lacuna.analysis.comparison.study import Lane, Study, rows, run
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.recording.channel import on_one_time
from lacuna.analysis.recording.formats import read_recorded
from lacuna.recorded_units import UnitError, factor_into, to_si
from lacuna.written import whole_files


def compare_lanes(
    scenarios: Sequence[Scenario],
    compiled: Callable[[str], runtime.Model],
    out: Path,
    tick: Callable[[Scenario, Lane], None] = lambda scenario, lane: None,
    inputs: Sequence[Path] = (),
) -> list[Study]:
    """Run every scenario; write deviations.csv, figures and report.html into `out`, all together at the end.

    `compiled` gives the model of a qualified name; `inputs` are files that say what is run.
    """
    studies, units, hashes = [], {}, {}
    for scenario in scenarios:
        model = compiled(scenario.model)
        for name in scenario.shown:
            model.variable(name)
        studies.append(run(scenario, model, lambda lane, s=scenario: tick(s, lane)))
        units[scenario.name] = {name: v.unit for name, v in model.variables.items()}
        hashes[model.name] = model.hash
    with whole_files(out) as folder:
        _write_csv(folder / "deviations.csv", [row for study in studies for row in rows(study)])
        _write_report(studies, units, folder, inputs, hashes)
    return studies


def _write_csv(path: Path, table: Sequence[dict[str, object]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(table[0]))
        writer.writeheader()
        writer.writerows(table)


def _write_report(
    studies: Sequence[Study],
    units: dict[str, dict[str, str]],
    folder: Path,
    inputs: Sequence[Path],
    hashes: Mapping[str, str],
) -> None:
    from lacuna.analysis.comparison.figures import draw_all
    from lacuna.analysis.comparison.report import report_html

    figures = {s.scenario.name: draw_all(s, units[s.scenario.name], folder) for s in studies}
    page = report_html(studies, figures, folder, inputs, hashes)
    (folder / "report.html").write_text(page, encoding="utf-8")


def compare_with_file(
    result: runtime.Result, time: np.ndarray, columns: dict[str, np.ndarray]
) -> list[SignalDeviation]:
    """Deviation of each column of a file (the reference) from a run on the same instants `time` (s).

    Raises AnalysisError where the run ended early or a column is not a variable of the model.
    """
    if not result.complete:
        raise AnalysisError(str(result.failure))
    use = np.ones(time.shape, dtype=bool)
    return [
        signal_deviation(name, time, values, result[name], use & np.isfinite(values))
        for name, values in columns.items()
    ]


def read_columns(path: Path, units: Mapping[str, str]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """`time` and the channels of a recording in the `units` that the variables of these names declare; missing samples
    are NaN. `event` is left out. A head that is a variable's whole name says no unit by its end. Raises AnalysisError
    where a channel is of another quantity."""
    channels = [channel for channel in read_recorded(path).channels if channel.name != "event"]
    if not channels:
        raise AnalysisError(f"{path}: there is no signal in it")
    time, values = on_one_time(channels)
    columns = {}
    for channel, column in zip(channels, values, strict=True):
        head, name = channel.head, channel.name
        if head.text in units and not head.sure:
            if head.unread and units[head.text]:
                raise AnalysisError(f"{path}: {name} is in {head.unread}, which is no unit known here")
            columns[head.text] = column
            continue
        factor, si = to_si(channel.unit) if channel.unit else (1.0, "")
        try:
            into = factor_into(units.get(name, ""), si) if si else 1.0
        except UnitError as error:
            raise AnalysisError(f"{path}: {head.text}: {error}, which {name} is in") from None
        columns[name] = column if factor * into == 1.0 else factor * into * column
    if len(time) < 2:
        raise AnalysisError(f"{path}: at least two lines are needed")
    if not np.all(np.diff(time) >= 0):
        row = int(np.flatnonzero(~(np.diff(time) >= 0))[0])
        raise AnalysisError(f"{path}: time must not decrease: {time[row + 1]:g} s comes after {time[row]:g} s")
    return time, columns
