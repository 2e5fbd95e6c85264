"""Scenarios: which model, with which faults, for how long, compared at which steps. Read from a TOML file."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path

from lacuna.given import toml_of
from lacuna.runtime import RecordedInput

DEFAULT_FILE = Path(__file__).with_name("scenarios.toml")


class ScenarioError(Exception):
    """A scenario file that cannot be used; the message names the file, the scenario and the key."""

    user_error = True


@dataclass(frozen=True)
class Scenario:
    """One comparison. Times in s; `steps` are those of the fixed-step lanes, coarse to fine."""

    name: str
    title: str
    model: str
    stop: float
    interval: float
    steps: tuple[float, ...]
    shown: tuple[str, ...]  # signals of the overlay figure
    parameters: dict[str, float] = field(default_factory=dict)
    inputs: dict[str, RecordedInput | float] = field(default_factory=dict)  # a file of scenarios has constants only
    reference_rtol: float = 1e-12
    variable_rtol: tuple[float, ...] = (1e-4, 1e-6, 1e-8)

    def __post_init__(self) -> None:
        for key in ("stop", "interval", "reference_rtol"):
            if not getattr(self, key) > 0:
                raise ScenarioError(f"scenario {self.name}: {key} must be greater than zero")
        if not self.steps or min(self.steps) <= 0:
            raise ScenarioError(f"scenario {self.name}: steps must be one or more numbers greater than zero")


def load(file: Path = DEFAULT_FILE) -> list[Scenario]:
    """All scenarios of `file`, in its order."""
    tables = toml_of(file, ScenarioError)
    return [_scenario(file, name, table) for name, table in tables.items()]


def _scenario(file: Path, name: str, table: dict) -> Scenario:
    known = {f.name: f for f in fields(Scenario) if f.name != "name"}
    for key in table:
        if key not in known:
            raise ScenarioError(f"{file}: [{name}]: unknown key '{key}'; known are {', '.join(known)}")
    required = ("title", "model", "stop", "interval", "steps", "shown")
    for key in required:
        if key not in table:
            raise ScenarioError(f"{file}: [{name}]: '{key}' is missing")
    lists = {key: tuple(value) if isinstance(value, list) else value for key, value in table.items()}
    return Scenario(name=name, **lists)
