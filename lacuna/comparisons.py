"""Solvers held against each other, and a model against a file from elsewhere."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from lacuna.errors import UserError, nearest
from lacuna.extras import names_missing_packages
from lacuna.inputs import Input, as_inputs
from lacuna.models import POINTS, Model, load
from lacuna.notebook import page, paragraph, table
from lacuna.progress import Progress, silent
from lacuna.texts import file_name

if TYPE_CHECKING:
    from lacuna.analysis.comparison.scenarios import Scenario
    from lacuna.analysis.comparison.study import Study
    import lacuna.runtime as runtime

SHOWN = 4  # signals in the overlay of a user's model
OWN_REFERENCE = 1e-10  # relative tolerance of the reference run of a user's model; tighter may be below its rounding
Row = tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """Every solver against a tight reference, on scenarios: a table a scenario, and what they say."""

    columns: ClassVar[Row] = (
        "solver", "largest deviation", "event times, s", "events without partner", "order", "steps", "ms",
    )  # fmt: skip
    tables: dict[str, tuple[Row, ...]]  # by the scenario's title
    findings: tuple[str, ...]
    folder: Path

    def _repr_html_(self) -> str:
        parts = [paragraph(title) + table(self.columns, rows) for title, rows in self.tables.items()]
        return page("comparison of solvers", *parts, *map(paragraph, self.findings))


@dataclass(frozen=True)
class Agreement:
    """A model and a file from elsewhere, signal by signal: largest deviation, RMS, both as a share of the signal's
    magnitude, and the time (s) of the largest."""

    model: str
    file: Path
    tolerance: float
    rows: tuple[tuple[str, float, float, float, float], ...]  # signal, maximum, RMS, relative, time
    missing: tuple[tuple[str, int, int], ...] = ()  # signal, samples that the file lacks, of how many instants

    @property
    def beyond(self) -> list[str]:
        """Signals that deviate by more than the tolerance."""
        return [row[0] for row in self.rows if not row[3] <= self.tolerance]

    def _repr_html_(self) -> str:
        header = ("signal", "largest deviation", "RMS", "of its magnitude", "at, s")
        return page(f"{self.model} and {self.file}", table(header, self.rows))


@names_missing_packages
def compare(
    model: str | Path | None = None,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    parameters: Mapping[str, float] | None = None,
    inputs: Mapping[str, Input] | None = None,
    only: Sequence[str] | None = None,
    scenarios: str | Path | None = None,
    steps: Sequence[float] | None = None,
    stop: float | None = None,
    out: str | Path | None = None,
    progress: Progress | None = None,
) -> Comparison:
    """Compare solvers on `model`, or on `scenarios` (a TOML file; default: those of the project; `only` some of them).

    Deviation of every signal and of event times, observed order of convergence, work and time; tables, figures and one
    report go to `out` (default: out/compare). `steps`: fixed steps to try on `model`, s. Needs the extra `maps`.
    """
    from lacuna.analysis.comparison.compare import compare_lanes
    from lacuna.analysis.comparison.report import findings
    from lacuna.analysis.comparison.scenarios import DEFAULT_FILE

    tell = progress or silent

    def compiled(name: str) -> runtime.Model:
        return load(name, class_name=class_name if model else "", libraries=libraries).translated

    if model is not None:
        own = load(model, class_name=class_name, libraries=libraries)
        chosen, file = [_own(str(model), own, steps, stop, parameters or {}, inputs or {})], Path(model)
    else:
        file = Path(scenarios) if scenarios else DEFAULT_FILE
        chosen = _chosen(file, only)
    folder = Path(out) if out else Path("out/compare") / (chosen[0].name if model else "")
    studies = compare_lanes(chosen, compiled, folder, lambda s, lane: tell(f"{s.name}: {lane.label}", None), [file])
    tables = {f"{study.scenario.name}: {study.scenario.title}": _lanes(study) for study in studies}
    return Comparison(tables, tuple(findings(studies)), folder)


def _chosen(file: Path, names: Sequence[str] | None) -> list[Scenario]:
    from lacuna.analysis.comparison.scenarios import load as read

    known = {scenario.name: scenario for scenario in read(file)}
    for name in names or []:
        if name not in known:
            raise UserError(f"there is no scenario {name}{nearest(name, known)}")
    return [known[name] for name in names or known]


def _own(
    name: str, model: Model, steps: Sequence[float] | None, stop: float | None, parameters: Mapping[str, float],
    inputs: Mapping[str, Input],
) -> Scenario:  # fmt: skip
    """A user's model as a scenario: its experiment, steps from the interval downwards; in the overlay its states, or
    where it has none, or events choose them, what is computed."""
    from lacuna.analysis.comparison.scenarios import Scenario

    end = stop or model.stop_time
    interval = model.interval or end / 1000
    if not {v.kind for v in model.variables.values()} - {"parameter"}:
        raise UserError(f"{name} has no variable that changes: there is nothing to compare")
    tried = tuple(steps or [interval / k for k in (1, 2, 4)])
    continuous = [name for name, v in model.variables.items() if v.kind in ("algebraic", "discrete")]
    short, shown = file_name(model.name), tuple(model.states or continuous)[:SHOWN]
    return Scenario(
        short, model.name, name, end, interval, tried, shown, dict(parameters),
        as_inputs(inputs, model.variables), reference_rtol=OWN_REFERENCE,
    )  # fmt: skip


def _lanes(study: Study) -> tuple[Row, ...]:
    from lacuna.analysis.comparison.report import order_text

    return tuple(
        (
            result.lane.label, result.failure or f"{result.error:.1e}", f"{result.events.maximum:.1e}",
            str(result.events.unmatched), order_text(study, result.lane.family) if result.lane.step else "",
            str(result.counters["steps"]), f"{1e3 * result.seconds:.1f}",
        )
        for result in study.lanes
    )  # fmt: skip


@names_missing_packages
def compare_with_file(
    model: str | Path,
    file: str | Path,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    parameters: Mapping[str, float] | None = None,
    inputs: Mapping[str, Input] | None = None,
    tolerance: float = 1e-3,
    stop: float | None = None,
    progress: Progress | None = None,
) -> Agreement:
    """Simulate a model on the instants of a file produced elsewhere and compare.

    `file` is a recording in any format that is read (full names as heads; units, where it says them, are turned into
    those of the model), or an .fmu, which is simulated up to `stop` (s; default: the model's) beside the model, with
    the same parameters and inputs where it has them, and compared in all variables whose names are the model's (extra
    `fmi`). `tolerance`: the largest deviation that agrees, of a signal's magnitude. Raises AnalysisError where the file
    is no such table or FMU or the run ends early.
    """
    from lacuna.analysis.comparison.compare import compare_with_file as compared
    from lacuna.analysis.comparison.compare import read_columns

    loaded = load(model, class_name=class_name, libraries=libraries, parameters=parameters)
    if Path(file).suffix == ".fmu":
        time, columns = _simulated(loaded, Path(file), stop, parameters or {}, inputs or {})
    else:
        time, columns = read_columns(Path(file), {name: v.unit for name, v in loaded.variables.items()})
    result = loaded.run_at(time, list(columns), inputs or {}, progress)
    found = compared(result, time, columns)
    rows = tuple((d.name, d.maximum, d.rms, d.relative, d.at_time) for d in found)
    lacking = ((name, int(np.isnan(values).sum()), len(time)) for name, values in columns.items())
    return Agreement(loaded.name, Path(file), tolerance, rows, tuple(m for m in lacking if m[1]))


def _simulated(
    model: Model, file: Path, stop: float | None, parameters: Mapping[str, float], inputs: Mapping[str, Input]
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Time (s) and columns of a foreign FMU, driven as the model is."""
    from lacuna.analysis.comparison.foreign import simulate_fmu

    end = model.stop_time if stop is None else stop
    names = {name for name, v in model.variables.items() if not v.is_parameter}
    return simulate_fmu(
        file, names, {name: v.unit for name, v in model.variables.items()},
        model.start_time, end, model.interval or (end - model.start_time) / POINTS,
        min(model.tolerance or 1e-6, 1e-6), dict(parameters), as_inputs(inputs, model.variables),
    )  # fmt: skip
