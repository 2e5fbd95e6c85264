"""Plants for tests that need no translated model."""

from __future__ import annotations

from pathlib import Path

from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import Record, SourceEquation
from lacuna.analysis.settings import PAPER, Settings, load_settings
from lacuna.analysis.severity.preparation import prepare_assessment
from tests.analysis.reference import declared, simulate


class ReferencePlant:
    """The hand-written simulation; counts its runs, and stops at the severity `fails_at` with `error`."""

    name = "reference actuator"
    solver = "rk4"

    def __init__(self, hash: str = "1", fails_at: float | None = None, error: BaseException | None = None):
        self.hash, self.runs = hash, []
        self.passes = {"by hand": 0.0}
        self.equations = [SourceEquation("J*a = tau < 0 & b", "rotor", "by hand:1")]
        self._fails_at, self._error = fails_at, error

    def undisturbed(self, name: str) -> float:
        return declared(name)

    def with_solver(self, solver: str) -> ReferencePlant:
        return self

    def run(self, severity: float, **parameters: float) -> Record:
        if severity == self._fails_at:
            raise self._error
        self.runs.append(severity)
        record = simulate(severity, **parameters)
        return Record(record[:3], record[3], record[4], {"steps": 100000, "state_events": 403})


def paper_settings(folder, *replacements: tuple[str, str]) -> Settings:
    """The paper's settings with pieces of their text replaced, written into `folder`.

    Without backlash and position transducer, which the hand-written simulation does not have, and what follows them.
    """
    text = PAPER.read_text(encoding="utf-8").partition('[[nuisances]]\nname = "backlash')[0]
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    path = folder / "settings.toml"
    path.write_text(text, encoding="utf-8")
    return load_settings(path)


def prepare_small_map(folder: Path) -> None:
    """A map of the hand-written simulation in `folder`/map, prepared for assessment at fewer conditions."""
    settings = paper_settings(folder, ("conditions = 7", "conditions = 3"), ("every = 10", "every = 13"))
    plant = ReferencePlant()
    prepare_assessment(plant, settings, build_map(plant, settings, folder / "map", figures=False))
