"""Operating maps of an actuator over a fault, and the severity that a recorded test shows on them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from lacuna.errors import UserError
from lacuna.extras import names_missing_packages
from lacuna.notebook import page, paragraph, table
from lacuna.progress import Progress, counted, silent
from lacuna.sources import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    import pandas as pd

    from lacuna.analysis.map.maps import Map
    from lacuna.analysis.map.plant import ModelPlant
    from lacuna.analysis.settings import Settings

PAPER_MAP = Path("out/maps/paper")
FIRST_LOOK = 5  # every fifth severity: a fifth of the time, and the curves already have their shape


class OperatingMap:
    """A map in `folder`: `map["rms_mean"]` is a feature over `severities`, both [severities], SI units.

    Features: rms_mean and rms_a, rms_b, ... (A), peak_a_hz, ... (Hz, NaN where there is none), speed_mean (rad/s).
    """

    def __init__(self, done: Map, settings: Settings) -> None:
        self._done, self._settings = done, settings
        self.folder = done.folder
        self.severities: np.ndarray = np.array([row.severity for row in done.rows])
        self._features = _features(done)

    @property
    def title(self) -> str:
        return str(self._done.summary["title"])

    @property
    def features(self) -> list[str]:
        return list(self._features)

    def __getitem__(self, feature: str) -> np.ndarray:
        """[severities], SI units. Raises KeyError with the features that there are."""
        if feature not in self._features:
            raise KeyError(f"a map has no {feature}; it has {', '.join(self._features)}")
        return self._features[feature]

    def __len__(self) -> int:
        return len(self.severities)

    @property
    def comparison(self) -> list[dict[str, Any]]:
        """Published quantities beside the reproduced ones: quantity, published, reproduced, unit."""
        return list(self._done.summary["comparison"])

    @property
    def seconds(self) -> dict[str, float]:
        return self._done.seconds

    @property
    def report(self) -> Path:
        """The page with all figures (where figures were drawn)."""
        return self.folder / "report.html"

    @names_missing_packages
    def to_pandas(self) -> pd.DataFrame:
        """One column a feature, the index is the severity. Needs the extra `results`."""
        import pandas as pd

        return pd.DataFrame(self._features, index=pd.Index(self.severities, name=self._settings.fault.symbol))

    @names_missing_packages
    def plot(self, *features: str) -> Figure:
        """Features (default: the mean RMS) over the fault's severity. They must share a unit."""
        from lacuna.figures import over_axis

        fault, names = self._settings.fault, features or ("rms_mean",)
        units = {_unit(name) for name in names}
        if len(units) > 1:
            raise UserError(f"features in {' and '.join(sorted(units))} do not share an axis: draw them one by one")
        label = f"{fault.name}, {fault.unit}"
        return over_axis(fault.scale * self.severities, label, {name: self[name] for name in names}, units.pop())

    def __repr__(self) -> str:
        return f"<OperatingMap of {self._done.summary['model']['name']}: {len(self)} severities in {self.folder}>"

    def _repr_html_(self) -> str:
        picture = self.folder / "fig5_mean_rms.svg"
        drawn = picture.read_text(encoding="utf-8").partition("<svg") if picture.exists() else ("", "", "")
        columns = ("quantity", "published", "reproduced", "unit")
        rows = [[row[name] for name in columns] for row in self.comparison]
        return page(self.title, drawn[1] + drawn[2], table(columns, rows) if rows else "")


def _unit(feature: str) -> str:
    return "A" if feature.startswith("rms") else "Hz" if feature.endswith("_hz") else "rad/s"


def _features(done: Map) -> dict[str, np.ndarray]:
    letters = "abcdefgh"[: len(done.rows[0].rms)]
    values: dict[str, list[Any]] = {f"rms_{c}": [row.rms[k] for row in done.rows] for k, c in enumerate(letters)}
    values["rms_mean"] = [row.rms_mean for row in done.rows]
    values |= {f"peak_{c}_hz": [row.peak_hz[k] for row in done.rows] for k, c in enumerate(letters)}
    values["speed_mean"] = [row.speed_mean for row in done.rows]
    return {name: np.array(column, dtype=float) for name, column in values.items()}


@dataclass(frozen=True)
class CombinedMap:
    """A map over two faults at once, for `assess`: `first` and `second` name them with their number of severities."""

    folder: Path
    first: tuple[str, int]
    second: tuple[str, int]

    def _repr_html_(self) -> str:
        return page(f"{self.first[0]} with {self.second[0]}", paragraph(self.sentence))

    @property
    def sentence(self) -> str:
        return f"{self.first[1]} severities of {self.first[0]}, {self.second[1]} of {self.second[0]}"


@names_missing_packages
def maps(
    actuator: str | Path | None = None,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    settings: str | Path | None = None,
    out: str | Path | None = None,
    jobs: int | None = None,
    fresh: bool = False,
    figures: bool = True,
    prepare: bool = False,
    progress: Progress | None = None,
) -> OperatingMap:
    """Simulate a pre-flight test at every severity of a fault and write map.csv, figures and report.html.

    `actuator` is a model as `load` takes it, by default that of `settings` (a TOML file; default: the paper's
    actuator). `out` defaults to out/maps/NAME of the settings; rows are kept there, so an interrupted map goes on where
    it stopped, and `fresh` computes them again. `prepare` adds what `assess` needs (minutes). `jobs`: simulations at
    once, default one a core. Raises AnalysisError where a setting, a run or its analysis fails; then the folder keeps
    the map that it had. Needs the extra `maps`.
    """
    from lacuna.analysis.map.maps import build_map
    from lacuna.analysis.severity.preparation import prepare_assessment
    from lacuna.analysis.severity.sensitivities import require_nuisances

    chosen = _settings(settings)
    plant = _plant(str(actuator or chosen.model), class_name, libraries, chosen)
    disturbed = plant if actuator or not prepare else _plant(chosen.disturbed_model, "", libraries, chosen)
    if prepare:
        require_nuisances(disturbed, chosen)
    folder = Path(out) if out else Path("out/maps") / chosen.path.stem
    tell = counted(f"map of {plant.name}", progress)
    done = build_map(plant, chosen, folder, jobs=jobs, progress=tell, resume=not fresh, figures=figures)
    if prepare:
        (progress or silent)("what the assessment of a recording needs", None)
        prepare_assessment(disturbed, chosen, done, jobs=jobs)
    return OperatingMap(done, chosen)


@names_missing_packages
def growing_map(
    actuator: str | Path | None = None, *, class_name: str = "", libraries: Iterable[str | Path] = (),
    settings: str | Path | None = None, out: str | Path | None = None, jobs: int | None = None,
    progress: Progress | None = None,
) -> Iterator[OperatingMap]:  # fmt: skip
    """The map of `maps` without figures, twice: at every fifth severity for a first look, then whole and written; by
    the assessment's solver, which is the faster one."""
    from lacuna.analysis.map.maps import build_map, first_look

    chosen = _settings(settings)
    plant = _plant(str(actuator or chosen.model), class_name, libraries, chosen, quick=True)
    folder = Path(out) if out else Path("out/maps") / chosen.path.stem
    tell = counted(f"map of {plant.name}", progress)

    looks = partial(first_look, every=FIRST_LOOK), partial(build_map, figures=False)
    return (OperatingMap(look(plant, chosen, folder, jobs=jobs, progress=tell), chosen) for look in looks)


@names_missing_packages
def combined_maps(
    other: str,
    actuator: str | Path | None = None,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    settings: str | Path | None = None,
    out: str | Path | None = None,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> CombinedMap:
    """A map over the fault of `settings` and the `other` one (the symbol of a [[combined]] entry), for `assess`; `out`
    defaults to out/maps/NAME-with-OTHER, the rest is as in `maps`."""
    from lacuna.analysis.severity.combined.grid import build_grid, other_fault

    chosen = _settings(settings)
    second = other_fault(chosen, other)
    folder = Path(out) if out else Path("out/maps") / f"{chosen.path.stem}-with-{other}"
    plant = _plant(str(actuator or chosen.disturbed_model), class_name, libraries, chosen)
    tell = counted(f"map of {chosen.fault.name} with {second.name}", progress)
    grid = build_grid(plant, chosen, second, folder, jobs=jobs, progress=tell)
    return CombinedMap(folder, (chosen.fault.name, len(grid.x)), (second.name, len(grid.y)))


@names_missing_packages
def default_settings() -> Path:
    """The settings of the paper's actuator, a TOML file that explains every entry: copy it and begin from there."""
    from lacuna.analysis.settings import PAPER

    return PAPER


def _settings(path: str | Path | None) -> Settings:
    from lacuna.analysis.settings import PAPER, load_settings

    return load_settings(path or PAPER)


def _plant(
    model: str, class_name: str, libraries: Iterable[str | Path], settings: Settings, quick: bool = False
) -> ModelPlant:
    """`quick`: while somebody waits, compiled in half the time, and solved as the assessment's tests are."""
    from lacuna.analysis.map.plant import ModelPlant

    compiled = Source.of(model, class_name, libraries).compiled(quick=quick)
    return ModelPlant.of(compiled, settings, settings.quick_solver if quick else None)


@dataclass(frozen=True)
class Assessment:
    """How far a fault has gone. `severity` with its 95 % interval `low` to `high` is in the unit of the map's axis."""

    recording: str
    severity: float
    low: float
    high: float
    band: str
    sentence: str
    warnings: tuple[str, ...]
    features: dict[str, Any]
    folder: Path | None

    def _repr_html_(self) -> str:
        picture = self.folder / "assessment.svg" if self.folder else None
        drawn = picture.read_text(encoding="utf-8").partition("<svg") if picture and picture.exists() else ("", "", "")
        return page(self.recording, paragraph(self.sentence), drawn[1] + drawn[2], *map(paragraph, self.warnings))


@names_missing_packages
def assess(
    recording: str | Path,
    map: str | Path | OperatingMap | CombinedMap = PAPER_MAP,
    *,
    columns: Sequence[str] | None = None,
    unfiltered: bool = False,
    out: str | Path | None = None,
    progress: Progress | None = None,
) -> Assessment:
    """The severity that a recorded pre-flight test shows, by a map that was prepared for it; by a map over two faults,
    both.

    `recording` is in any format that is read: time and phase currents in `columns` (in the map's order; default:
    the map's own names), `unfiltered` where they did not pass the map's filters. With `out`, assessment.json, a
    figure and report.html are written there. Raises Refusal with the reason where the map does not cover the
    recording. Needs the extra `maps`.
    """
    from lacuna.analysis.severity.assessment import assess as one
    from lacuna.analysis.severity.combined.assessment import assess_both
    from lacuna.analysis.severity.combined.grid import GRID_FILE

    folder = Path(map) if isinstance(map, str | Path) else map.folder
    if not (folder / "settings.toml").is_file():
        raise UserError(f"{folder} holds no map: `lacuna maps --prepare` (or maps(prepare=True)) draws one")
    (progress or silent)(f"reading {recording}", None)
    names = list(columns) if columns else None
    target = Path(out) if out else None
    if (folder / GRID_FILE).exists():
        both = assess_both(recording, folder, target, columns=names, unfiltered=unfiltered)
        return _assessment(both, both.estimate.first, target)
    found = one(recording, folder, target, columns=names, unfiltered=unfiltered)
    return _assessment(found, found.estimate, target)


def _assessment(found: Any, estimate: Any, folder: Path | None) -> Assessment:
    return Assessment(
        cast(str, found.recording), float(estimate.severity), float(estimate.low), float(estimate.high),
        cast(str, found.band.name), cast(str, found.sentence), tuple(found.warnings), dict(found.features), folder,
    )  # fmt: skip
