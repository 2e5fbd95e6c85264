"""What a map is drawn of: something that gives a record of its pre-flight test at any severity."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
import hashlib
from pathlib import Path
import threading
from typing import Protocol

import numpy as np

from lacuna import runtime
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import Settings
from lacuna.runtime.library import library_path as runtime_library_path
from lacuna.suggest import suggestion


@dataclass(frozen=True)
class Record:
    """One test, sampled as the settings say from time 0."""

    currents: np.ndarray  # A, [channels, samples]
    speed: np.ndarray  # rad/s
    angle: np.ndarray  # rad, not wrapped
    counters: dict[str, int]  # of the solver


@dataclass(frozen=True)
class SourceEquation:
    """An equation as written in the model, for the report."""

    text: str
    origin: str  # component path
    place: str  # file:line


class Plant(Protocol):
    """`hash` must change with everything that may change a record."""

    name: str
    hash: str
    solver: str
    passes: dict[str, float]  # seconds of each pass of its translation; empty where there was none
    equations: list[SourceEquation]

    def run(self, severity: float, **parameters: float) -> Record: ...

    def undisturbed(self, name: str) -> float:
        """The value of a parameter in every test that nothing disturbs."""
        ...

    def with_solver(self, solver: str) -> Plant:
        """The same plant, solved in another way."""
        ...


class ModelPlant:
    """A translated model, solved by the runtime.

    `path` is its shared object, `model_hash` the hash of its sources and `passes` the seconds that each pass of the
    translation took; all three come from the compiler's result. `solver`: another one than the settings'.
    """

    def __init__(self, name: str, path: Path | str, model_hash: str, settings: Settings, passes=None, solver=None):
        self._path, self._model_hash = path, model_hash
        self.name, self.passes, self._settings = name, dict(passes or {}), settings
        self.solver = solver or settings.solver
        self._model = runtime.Model(path)
        self._times = np.arange(settings.samples) / settings.sampling_rate
        self._outputs = [*settings.currents, settings.speed, settings.angle]
        self._of_thread = threading.local()
        known = self._model.variables
        missing = [v + suggestion(v, known) for v in self._outputs if v not in known]
        if missing:
            raise AnalysisError(f"{settings.path}: model {name} has no variable {', nor '.join(missing)}")
        self._require_parameters([settings.fault.parameter, *settings.own_parameters])
        runtime_hash = hashlib.sha256(runtime_library_path().read_bytes()).hexdigest()
        self.hash = f"{model_hash} {runtime_hash[:16]} {self.solver}"
        self.equations = [
            SourceEquation(e.text, e.origin, f"{Path(e.file).name}:{e.line}") for e in self._model.equations
        ]

    @property
    def units(self) -> dict[str, str]:
        """The unit of each variable; "1" without one."""
        return {name: variable.shown_unit for name, variable in self._model.variables.items()}

    @classmethod
    def of(cls, compiled, settings: Settings, solver: str | None = None) -> ModelPlant:
        """Of what the compiler returns: name, path, hash and a report with the seconds of its passes."""
        return cls(compiled.name, compiled.path, compiled.hash, settings, compiled.report.seconds, solver)

    def with_solver(self, solver: str) -> ModelPlant:
        return ModelPlant(self.name, self._path, self._model_hash, self._settings, self.passes, solver)

    def _session(self) -> runtime.Session:
        """A session of this thread's own, set up once."""
        if not hasattr(self._of_thread, "session"):
            settings = self._settings
            self._of_thread.session = runtime.Session(
                self._model,
                solver=self.solver,
                rtol=settings.relative_tolerance,
                atol=settings.absolute_tolerance,
                outputs=self._outputs,
                output_times=self._times,
                events=False,
            )
        return self._of_thread.session

    def run(self, severity: float, **parameters: float) -> Record:
        """Simulate one test, with `parameters` other than declared.

        Raises AnalysisError with severity, time and reason where the run does not complete.
        """
        settings = self._settings
        values = settings.own_parameters | {settings.fault.parameter: severity} | parameters
        result = self._session().run(values, start=0.0, stop=float(self._times[-1]))
        if not result.complete:
            raise AnalysisError(f"{self.name} at {settings.fault.symbol} = {severity:g}: {result.failure}")
        return Record(
            currents=np.array([result[name] for name in settings.currents]),
            speed=result[settings.speed],
            angle=result[settings.angle],
            counters=dict(result.counters),
        )

    def undisturbed(self, name: str) -> float:
        """The value of a parameter in every test that nothing disturbs: the settings', or what the model declares.

        Raises AnalysisError where the model has no parameter of that name that can be set.
        """
        self._require_parameters([name])
        return self._settings.own_parameters.get(name, self._model.parameters[name].start)

    def _require_parameters(self, names: Iterable[str]) -> None:
        """Of the settings, where they are to have another value."""
        model, place = self._model, self._settings.path
        for name in names:
            if name in model.parameters:
                continue
            if name in model.variables and model.variables[name].is_parameter:
                reason = "cannot be set: it is a constant, or given by other parameters"
                raise AnalysisError(f"{place}: {name} of model {self.name} {reason}")
            hint = suggestion(name, model.parameters)
            raise AnalysisError(f"{place}: model {self.name} has no parameter {name}{hint}")
