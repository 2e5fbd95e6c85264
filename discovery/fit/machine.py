"""A compiled model bound to a case: parameters in, simulated output signals out, on each recording's own samples."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
import queue
import threading

import numpy as np

from lacuna.codegen.cache import CompilerError
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from lacuna.discovery.case.case_model import UNITS
from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.noise import Noise
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.values import is_start, start_name, values_in
from lacuna.discovery.catalogue.amend import Amendment, probe_name, tracker_name
from lacuna.discovery.catalogue.attachment import OWN
from lacuna.discovery.catalogue.searched import believed_aliases, write_source
from lacuna.discovery.fit.tracking import Motion, recorded_column, recorded_motion
from lacuna.recorded_units import same_unit
from lacuna.runtime import Model, RecordedInput, Session, SimulationError
from lacuna.suggest import did_you_mean, suggestion

RTOL, LEAST_RTOL, FINER = 1e-6, 1e-9, 0.1  # of the solver: usual, least, and the step from one to the next finer one
NEGLIGIBLE = 1e-3  # RMS of the solver's errors, in units of noise; friction that is added makes ten times as much of it
STEPS_PER_SAMPLE, STEPS = 40, 1_000_000  # a run that needs more of both is given up: its parameters are absurd
STEPS_GROWTH = 10  # so is a hypothesis that needs so many times the steps of the model it amends


class Machine:
    """The believed model of a case with an amendment, compiled; safe to simulate from several threads."""

    def __init__(
        self, case: Case, amendment: Amendment, solver: str = "dopri5", source: Path | None = None,
        step_limits: Mapping[str, int] | None = None, rtol: float = RTOL,
    ):  # fmt: skip
        self.case, self.amendment, self.solver, self.rtol = case, amendment, solver, rtol
        self.step_limits = step_limits or {}
        self.steps: dict[str, int] = {}
        self.path = source or write_source(amendment)
        self.compiled = compile_model(str(self.path), search_path=case.search_path, quick=True, units=UNITS)
        self.model = Model(self.compiled.path)
        self.columns = {s.column: amendment.output(s.variable) for s in case.outputs}
        self._check_signals()
        self._sessions: dict[tuple[str, bool], queue.SimpleQueue[Session]] = {}
        self._inputs: dict[str, dict[str, RecordedInput]] = {}
        self._initial: dict[str, dict[str, float]] = {}
        for name in {n for r in (*case.fit, *case.validate) for n in self._starts(r)}:
            self._start(name, 0.0)  # no run may find that a hypothesis has other states
        self._lock = threading.Lock()
        probes = [*(probe_name(k) for k in range(len(amendment.probes))), *amendment.inputs]
        self._silent = {name: RecordedInput([0.0], [0.0], "hold") for name in probes}

    def _check_signals(self) -> None:
        for signal in self.case.signals.values():
            among = self.model.inputs if signal.role == "input" else self.model.variables
            variable = among.get(signal.variable)
            where = f"{self.case.folder / 'case.toml'}: [signals.{signal.column}]"
            if variable is None:
                kind = "input" if signal.role == "input" else "variable"
                raise CaseError(f"{where} model {self.case.model} has no {kind} `{signal.variable}`")
            if not same_unit(variable.unit, signal.model_unit):
                raise CaseError(
                    f"{where} unit {signal.unit} does not fit {signal.variable}, which is in {variable.unit}"
                )
        tables = [("parameters", self.case.parameters), ("uncertainty", self.case.uncertainty)]
        tables += [(f'recording."{n}".parameters', own.parameters) for n, own in self.case.own.items()]
        tables += [(f'recording."{n}".uncertainty', own.uncertainty) for n, own in self.case.own.items()]
        for table, values in tables:
            for name in values:
                self._check_parameter(table, name)
        inputs = self.model.inputs
        own = [n for n in inputs if n.startswith(OWN)]
        given = (*(s.variable for s in self.case.inputs), *self.amendment.inputs, *own)
        driven = {inputs[n].index for n in given}  # which aliases of an input share
        for name in (n for n, v in inputs.items() if v.index not in driven):
            raise CaseError(f"{self.case.folder / 'case.toml'}: input `{name}` of the model is not recorded")

    def _check_parameter(self, table: str, name: str) -> None:
        if name not in self.model.variables:
            hint = did_you_mean(name, self.model.parameters)
            raise CaseError(
                f"{self.case.folder / 'case.toml'}: [{table}] the model has no parameter `{name}`"
                + (f"; {hint}" if hint else "")
            )

    def amended(self, amendment: Amendment, case: Case | None = None) -> Machine:
        """The believed model with another amendment, or bound to another case, simulated in the same way."""
        return Machine(case or self.case, amendment, self.solver, rtol=self.rtol)

    def precise(self, parameters: Mapping[str, float], noise: Mapping[str, Noise]) -> Machine:
        """The machine with a tolerance at which the solver's errors are negligible beside the noise of each output."""
        machine, here = self, self._outputs(parameters)
        while machine.rtol > LEAST_RTOL:
            finer = Machine(self.case, self.amendment, self.solver, source=self.path, rtol=FINER * machine.rtol)
            there = finer._outputs(parameters)
            if here is None or there is None or _differ(here, there, noise) < NEGLIGIBLE:
                break
            machine, here = finer, there
        return machine

    def _outputs(self, parameters: Mapping[str, float]) -> list[dict[str, np.ndarray]] | None:
        outputs = [self.simulate(parameters, r) for r in self.case.fit]
        return None if any(o is None for o in outputs) else outputs

    def motions(self) -> list[Motion | None]:
        """For each tracker of the amendment, which recorded signals give the motion of its shaft."""
        return [recorded_motion(self.case, self.model, shaft) for shaft in self.amendment.trackers]

    def recorded(self, variable: str) -> str | None:
        """The output that records a variable; None if none does."""
        return recorded_column(self.case, self.model, variable)

    def uncertain_states(self, recording: Recording) -> dict[str, float | None]:
        """States whose value at a recording's first sample is not exact, by the variable that case.toml names: that
        sample where they are recorded, None where nobody knows them."""
        if recording.after_gap:
            first = {v.index: n for n, v in reversed(self.model.states.items())}  # others are aliases of it
            return {first[index]: None for index in sorted(first)}
        said = self._starts(recording)
        noisy = [name for name, value in said.items() if value == "recorded" and self.recorded(name)]
        unknown = dict.fromkeys(n for n, v in said.items() if v == "unknown")
        return {n: self._first_sample(recording, n) for n in noisy} | unknown

    def simulate(
        self, parameters: Mapping[str, float], recording: Recording, efforts: Mapping[str, RecordedInput] | None = None,
        coarsely: bool = False,
    ) -> dict[str, np.ndarray] | None:  # fmt: skip
        """Output columns (n,) in SI, and the torque of each tracker under its name; None where the run fails. Taken
        `coarsely` for a first look: errors of a hundred times NEGLIGIBLE are still a tenth of the noise.

        `parameters` may hold `start:<variable>` for states with unknown start values; `efforts` drive probes."""
        values = values_in(parameters, recording)
        initial = self._initial_of(recording) | self._fitted_starts(parameters, recording)
        session = self._session(recording, coarsely)
        try:
            time = recording.time
            inputs = self._silent | dict(efforts or {})
            result = session.run(values, inputs, initial, start=float(time[0]), stop=float(time[-1]))
        except SimulationError:
            return None
        finally:
            self._sessions[recording.name, coarsely].put(session)
        if not result.complete or len(result) != len(recording.time):
            return None
        if not coarsely:
            self.steps[recording.name] = int(result.counters["steps"])
        names = self.columns | {t: f"{t}.tau" for t in self._trackers()}
        return {column: np.array(result[name]) for column, name in names.items()}

    def trajectory(
        self, parameters: Mapping[str, float], recording: Recording, names: list[str],
        efforts: Mapping[str, RecordedInput] | None = None,
    ) -> dict[str, np.ndarray]:  # fmt: skip
        """Any variables of the model along a recording; raises SimulationError where the run fails."""
        session = Session(
            self.model, solver=self.solver, rtol=self.rtol, outputs=names, output_times=recording.time, events=False,
            inputs=self._inputs_of(recording), max_steps=self._step_limit(recording),
        )  # fmt: skip
        time = recording.time
        initial = self._initial_of(recording) | self._fitted_starts(parameters, recording)
        result = session.run(
            values_in(parameters, recording), self._silent | dict(efforts or {}), initial,
            start=float(time[0]), stop=float(time[-1]),
        )  # fmt: skip
        if not result.complete or len(result) != len(time):
            raise SimulationError(str(result.failure))
        return {name: np.array(result[name]) for name in names}

    def events_per_second(self, parameters: Mapping[str, float], recording: Recording) -> float:
        session = self._session(recording)
        time = recording.time
        values, initial = values_in(parameters, recording), self._initial_of(recording)
        result = session.run(parameters=values, initial=initial, start=float(time[0]), stop=float(time[-1]))
        self._sessions[recording.name, False].put(session)
        return float(result.counters["state_events"]) / float(time[-1] - time[0])

    def constants(self, parameters: Mapping[str, float], recording: Recording | None = None) -> dict[str, float]:
        """Every parameter, dependent ones included, at these values of the free ones: on a recording, or the first."""
        recording = recording or self.case.fit[0]
        session = self._session(recording)
        begin = float(recording.time[0])
        result = session.run(parameters=values_in(parameters, recording), start=begin, stop=begin + recording.interval)
        self._sessions[recording.name, False].put(session)
        return result.parameters

    def _trackers(self) -> list[str]:
        return [tracker_name(k) for k in range(len(self.amendment.trackers))]

    def _session(self, recording: Recording, coarsely: bool = False) -> Session:
        with self._lock:
            pool = self._sessions.setdefault((recording.name, coarsely), queue.SimpleQueue())
        try:
            return pool.get_nowait()
        except queue.Empty:
            outputs = list(dict.fromkeys([*self.columns.values(), *(f"{t}.tau" for t in self._trackers())]))
            return Session(
                self.model, solver=self.solver, rtol=self.rtol / (FINER**2 if coarsely else 1), outputs=outputs,
                output_times=recording.time, events=False, inputs=self._inputs_of(recording),
                max_steps=self._step_limit(recording),
            )  # fmt: skip

    def _step_limit(self, recording: Recording) -> int:
        return self.step_limits.get(recording.name, max(STEPS_PER_SAMPLE * len(recording.time), STEPS))

    def _inputs_of(self, recording: Recording) -> dict[str, RecordedInput]:
        with self._lock:
            found = self._inputs.get(recording.name)
            if found is None:
                found = {s.variable: recording.played(s) for s in self.case.inputs}
                for tracker, motion in zip(self._trackers(), self.motions(), strict=True):
                    angle, speed = motion.of(recording)
                    found[f"{tracker}_phi"] = RecordedInput(recording.time, angle)
                    found[f"{tracker}_w"] = RecordedInput(recording.time, speed)
                self._inputs[recording.name] = found
        return found

    def _starts(self, recording: Recording) -> dict[str, float | str]:
        """What case.toml says of the states at a recording's first sample."""
        own = self.case.own.get(recording.file)
        return self.case.initial | (own.initial if own else {})

    def _initial_of(self, recording: Recording) -> dict[str, float]:
        if (found := self._initial.get(recording.name)) is None:
            found = {}
            for name, value in ({} if recording.after_gap else self._starts(recording)).items():
                if value == "recorded":
                    found |= self._start(name, self._first_sample(recording, name))
                elif value != "unknown":
                    found |= self._start(name, float(value))
            self._initial[recording.name] = found
        return found

    def _fitted_starts(self, parameters: Mapping[str, float], recording: Recording) -> dict[str, float]:
        """Start values among the fitted parameters; a state may go by another name there, of the model without an
        effect."""
        suffix = start_name("", recording).removeprefix("start:")
        named = {n.removesuffix(suffix): v for n, v in parameters.items() if is_start(n) and n.endswith(suffix)}
        return {state: x for n, v in named.items() for state, x in self._start(n.removeprefix("start:"), v).items()}

    def unfitted_states(self, parameters: Mapping[str, float], recording: Recording) -> dict[str, float | None]:
        """Those of the uncertain states of a recording that the parameters do not give."""
        given = self._fitted_starts(parameters, recording)
        return {n: v for n, v in self.uncertain_states(recording).items() if not self._start(n, 0.0).keys() & given}

    def _first_sample(self, recording: Recording, name: str) -> float:
        for signal in self.case.signals.values():
            if name in (signal.column, signal.variable):
                values = recording.columns[signal.column]
                return float(values[np.flatnonzero(np.isfinite(values))[0]])
        raise CaseError(f'{self.case.folder / "case.toml"}: [initial] {name} = "recorded", but no column records it')

    @cached_property
    def _believed_aliases(self) -> Mapping[str, tuple[str, int]]:
        return believed_aliases(self.amendment, self.case.search_path)

    def _start(self, name: str, value: float) -> dict[str, float]:
        """A state's start value under the first of its names, whose sign may be another; the amended model may have
        another of the variables as its state that are one in the believed one."""
        variable, sense = self.model.states.get(name), 1
        if variable is None and name in self.model.variables:
            same = self._believed_aliases
            known, own = same.get(name, (name, 1))
            equal = [(known, own), *((n, own * sign) for n, (of, sign) in same.items() if of == known)]
            variable, sense = next(((self.model.states[n], s) for n, s in equal if n in self.model.states), (None, 1))
        if variable is None:
            where = f"{self.case.folder / 'case.toml'}: [initial]"
            raise CaseError(f"{where} {name} is no state of {self.case.model}{suggestion(name, self.model.states)}")
        first = next(v for v in self.model.states.values() if v.index == variable.index)
        return {first.name: value * sense * variable.sign * first.sign}


def _differ(
    one: list[dict[str, np.ndarray]], other: list[dict[str, np.ndarray]], noise: Mapping[str, Noise]
) -> float:  # fmt: skip
    """The largest RMS difference of an output of a recording, in units of its noise."""
    pairs = [(a[c] - b[c]) / n.std for a, b in zip(one, other, strict=True) for c, n in noise.items()]
    return max(float(np.sqrt(np.mean(p**2))) for p in pairs)


def richer(case: Case, amendment: Amendment, base: Machine) -> Machine:
    """A machine that is simulated as `base` is, in no more than so many times its steps."""
    samples = {r.name: len(r.time) for r in case.fit}
    limits = {name: STEPS_GROWTH * max(steps, 1000, samples.get(name, 0)) for name, steps in base.steps.items()}
    return Machine(case, amendment, base.solver, step_limits=limits, rtol=base.rtol)


def try_machine(case: Case, amendment: Amendment, base: Machine) -> tuple[Machine | None, str]:
    """The same, or None and why it cannot be built (a hypothesis that does not fit this model)."""
    try:
        return richer(case, amendment, base), ""
    except (Diagnostic, CompilerError, SimulationError, CaseError) as error:
        return None, str(error)
