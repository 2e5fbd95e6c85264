"""What a simulation gave: columns by name, events, units; as a table, a figure, a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from lacuna.errors import UserError
from lacuna.extras import names_missing_packages
from lacuna.notebook import drawing, page, paragraph, table
import lacuna.runtime as runtime

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    import pandas as pd

Format = Literal["csv", "parquet", "mat"]
SHOWN = 4  # signals of the figure in a notebook


class IncompleteRun(UserError):
    """A simulation that ended before its stop time; `result` has the rows until then, the message says why."""

    def __init__(self, result: Result) -> None:
        super().__init__(str(result.failure))
        self.result = result


class Result:
    """`result["rotor.w"]` is the column of a variable in SI units, [rows]; `result.time` the time of each row, s.

    Every declared variable is there by its name: what equals another one up to sign, and what parameters alone decide,
    too; with `outputs` given to the run, those that were asked for.
    """

    def __init__(self, run: runtime.Result, names: Sequence[str] | None, seconds: float) -> None:
        self._run = run
        self.names: list[str] = [n for n in names if n != "time"] if names is not None else run.model.declared
        self.seconds = seconds  # of computing
        self.warnings: list[str] = list(run.warnings)  # what of the run should be known besides its values

    @property
    def model(self) -> str:
        """Full name of the model."""
        return self._run.model.name

    @property
    def time(self) -> np.ndarray:
        """s, [rows]"""
        return self._run.time

    @property
    def event_rows(self) -> np.ndarray:
        """[rows], true for those that were added at an event: one before it and one after it."""
        return self._run.event

    def __getitem__(self, name: str) -> np.ndarray:
        """[rows], SI units; a parameter is constant. Raises SimulationError with the nearest names if it is unknown."""
        return self._run[name]

    def __len__(self) -> int:
        return len(self._run)

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        return name in self._run or name in self._run.parameters

    @property
    def units(self) -> dict[str, str]:
        """Of every column, "" where neither the declaration nor the equations give one."""
        return {"time": "s"} | {name: v.shown_unit for name, v in self._run.model.variables.items() if name in self}

    @property
    def events(self) -> list[runtime.EventEntry]:
        """The event log: time (s), kind, and the relation as written in the model."""
        return self._run.event_log

    @property
    def parameters(self) -> dict[str, float]:
        """All parameters with the values used (SI units), dependent ones included."""
        return self._run.parameters

    @property
    def counters(self) -> dict[str, int]:
        """Steps, residuals, Jacobians, events, restarts, ... of the run."""
        return self._run.counters

    def sensitivity(self, output: str, parameter: str) -> np.ndarray:
        """d output / d parameter, [rows], SI units, at fixed time; by its initial value for a state in the place of a
        parameter. Not a number where it does not exist: `flags` says why. Raises SimulationError for what the run was
        not asked for."""
        return self._run.sensitivity(output, parameter)

    @property
    def sensitivities(self) -> tuple[str, ...]:
        """What the outputs were differentiated by."""
        return self._run.sensitivities

    @property
    def flags(self) -> list[runtime.Flag]:
        """Instants after which sensitivities hold on one side only, or not at all: events about to change order."""
        return self._run.flags

    @property
    def margins(self) -> dict[str, float]:
        """How far each parameter may go, to first order, before two events of the run change their order."""
        return self._run.margins

    @property
    def complete(self) -> bool:
        """The run reached its stop time, or terminate()."""
        return self._run.complete

    @property
    def failure(self) -> runtime.Failure | None:
        """Why the run ended early: a sentence with time, variable or equation, and source line."""
        return self._run.failure

    @property
    def terminated(self) -> str | None:
        """The message of the terminate() that ended the run."""
        return self._run.terminated

    def metadata(self) -> dict[str, Any]:
        """What `.meta.json` beside a file says: units, parameters, solver with its tolerances, counters, events."""
        return runtime.metadata(self._run, self.names)

    @names_missing_packages
    def to_pandas(self) -> pd.DataFrame:
        """One column a variable, the index is time in s. Needs the extra `results`."""
        import pandas as pd

        return pd.DataFrame({name: self[name] for name in self.names}, index=pd.Index(self.time, name="time"))

    @names_missing_packages
    def plot(self, *names: str) -> Figure:
        """One panel a unit, the named variables against time; by default what the model itself declares. Needs the
        extra `plot`."""
        from lacuna.figures import trajectories

        return trajectories(
            self.time, {name: self[name] for name in [n for n in names if n != "time"] or self._own()}, self.units
        )

    def _own(self) -> list[str]:
        """Real variables of the model itself; those of its components where it declares none."""
        variables = self._run.model.variables
        real = [n for n in self.names if variables[n].type == "Real" and variables[n].kind != "parameter"]
        return [n for n in real if "." not in n] or real

    @names_missing_packages
    def save(self, path: str | Path, format: Format | None = None) -> list[Path]:
        """Write the run by the ending of `path`, or as `format`: csv; parquet; mat (MATLAB, and the layout that
        Modelica tools read). Beside it stands a .meta.json with units, parameters, solver, events. All but csv need the
        extra `results`.

        Returns the files. Nobody ever sees half a file.
        """
        path = Path(path)
        kind = format or path.suffix.removeprefix(".")
        writers = {"csv": runtime.write_csv, "parquet": runtime.write_parquet, "mat": runtime.write_mat}
        if kind not in writers:
            raise UserError(f"{path}: the format of a result is {', '.join(writers)}, not {kind or 'nothing'}")
        return [writers[kind](self._run, path, self.names)]

    @names_missing_packages
    def save_plot(self, path: str | Path, *names: str) -> list[Path]:
        """Write the figure of `plot(*names)` as SVG. Needs the extra `plot`."""
        from lacuna.figures import write

        return [write(self.plot(*names), Path(path))]

    def __repr__(self) -> str:
        state = "complete" if self.complete else f"incomplete: {self.failure}"
        return f"<Result of {self.model}: {len(self)} rows of {len(self.names)} variables, {state}>"

    def _repr_html_(self) -> str:
        title = f"{self.model}: {len(self)} rows of {len(self.names)} variables, {len(self.events)} events"
        shown = self._own()[:SHOWN]
        rows = [(n, float(np.min(self[n])), float(np.max(self[n])), float(self[n][-1]), self.units[n]) for n in shown]
        parts = [table(("", "least", "largest", "last", "unit"), rows)] if len(self) else []
        parts += [paragraph(str(self.failure))] if self.failure else []
        try:
            parts.append(drawing(self.plot(*shown)))
        except ImportError:
            parts.append(paragraph("for figures: pip install 'lacuna[plot]'"))
        return page(title, *parts)
