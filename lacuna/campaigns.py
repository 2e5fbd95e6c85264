"""Sweeps: thousands of simulated tests over fault and nuisances, here or on a Dask cluster."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lacuna.errors import UserError
from lacuna.extras import names_missing_packages
from lacuna.notebook import page, table
from lacuna.progress import Progress, counted
from lacuna.sources import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    import pandas as pd
    import pyarrow as pa

SHOWN = 5  # rows in a notebook


class Sweep:
    """Simulated tests, one a row of `path` (Parquet): parameters, features (SI units), and why a test failed."""

    def __init__(self, path: Path) -> None:
        import pyarrow.parquet as pq

        self.path = path
        self.table: pa.Table = pq.read_table(path)

    @property
    def report(self) -> Path:
        """The page beside the results."""
        return self.path.with_name("report.html")

    @property
    def names(self) -> list[str]:
        return list(self.table.column_names)

    def __len__(self) -> int:
        return int(self.table.num_rows)

    def __getitem__(self, name: str) -> np.ndarray:
        """[tests]; NaN where a test failed. Raises KeyError with the names that there are."""
        if name not in self.names:
            raise KeyError(f"the sweep has no {name}; it has {', '.join(self.names)}")
        return np.asarray(self.table[name].to_numpy())

    @property
    def failures(self) -> list[str]:
        """Why tests failed, one sentence each."""
        return [text for text in self.table["failure"].to_pylist() if text is not None]

    @names_missing_packages
    def to_pandas(self) -> pd.DataFrame:
        """One row a test. Needs the extra `results`."""
        import pandas as pd

        return pd.DataFrame(self.table.to_pydict())

    @names_missing_packages
    def plot(self, x: str, y: str, colour: str = "") -> Figure:
        """One point a test: column `y` over `x`, coloured by another column. Needs the extra `plot`."""
        from lacuna.figures import cloud

        return cloud((x, self[x]), (y, self[y]), (colour, self[colour]) if colour else None)

    def __repr__(self) -> str:
        return f"<Sweep of {len(self)} tests, {len(self.failures)} failed: {self.path}>"

    def _repr_html_(self) -> str:
        rows = [list(row.values()) for row in self.table.slice(0, SHOWN).to_pylist()]
        return page(f"{len(self)} tests, {len(self.failures)} failed", table(self.names, rows))


@names_missing_packages
def sweep(
    actuator: str | Path | None = None,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    points: int = 1000,
    settings: str | Path | None = None,
    solver: str = "dopri5",
    scheduler: str | None = None,
    chunk: int = 16,
    out: str | Path | None = None,
    progress: Progress | None = None,
) -> Sweep:
    """Simulate and analyse `points` tests with fault and nuisances of `settings` drawn together (Sobol sequence).

    `actuator` is a model as `load` takes it, by default that of the settings' tests; `scheduler` the address of a Dask
    scheduler, by default this machine; `chunk` the tests a task. It goes on where it stopped, whatever was lost, from
    what is in `out` (default: out/sweeps/NAME of the settings). Raises UserError or AnalysisError where the solver, the
    settings or the scheduler cannot be used. results.parquet and report.html are written to `out`. Needs the extras
    `distributed` and `maps`.
    """
    from lacuna.analysis.campaign.points import sobol_points
    from lacuna.analysis.campaign.run import run_campaign
    from lacuna.analysis.campaign.work import Work
    from lacuna.analysis.map.plant import ModelPlant
    from lacuna.analysis.report import sweep as report
    from lacuna.analysis.settings import PAPER, load_settings
    from lacuna.runtime import ADAPTIVE

    if solver not in ADAPTIVE:
        raise UserError(f"a sweep is solved by {', '.join(ADAPTIVE)}, not by {solver}")
    chosen = load_settings(settings or PAPER)
    compiled = Source.of(actuator or chosen.disturbed_model, class_name, libraries).compiled()
    plant = ModelPlant.of(compiled, chosen)
    design = sobol_points(chosen, points, plant)
    work = Work(compiled.name, Path(compiled.path).read_bytes(), compiled.hash, chosen.text, solver)
    folder = Path(out) if out else Path("out/sweeps") / chosen.path.stem
    tell = counted(f"sweep of {compiled.name}", progress)
    results = run_campaign(work, design, folder, scheduler=scheduler, chunk=chunk, progress=tell)
    report.write(results, compiled.name, chosen, plant.units)
    return Sweep(results)
