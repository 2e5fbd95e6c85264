"""Models: found, translated, looked at, simulated."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
import time
from typing import Literal, get_args

import numpy as np

from lacuna.codegen.compile import CompiledModel, translate
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flat.text import dump_flat
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.structure.report import dump as dump_structure
from lacuna.errors import UserError
from lacuna.inputs import Input, as_inputs, as_numbers, assumed, check_kinds, uncovered
from lacuna.notebook import page, table
from lacuna.progress import Progress, silent, watching
from lacuna.results import IncompleteRun, Result
import lacuna.runtime as runtime
from lacuna.sources import Source, Units

Solver = Literal["ida", "dopri5", "rodas4", "rk4", "euler"]
Dump = Literal["flat", "structure", "c"]
POINTS = 500  # rows of a run whose model and caller name no interval, as Modelica tools have it
NO_VALUE = "F023"  # the code of a parameter without a value, which the caller may give


def dump(
    model: str | Path,
    what: Dump,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    units: Units = "error",
    data: Iterable[str | Path] = (),
    allow_external: bool = False,
) -> str:
    """What the passes made of a model, as text: its flat equations (also where later passes refuse it), its structure,
    or the generated C. Raises Diagnostic where the model is wrong."""
    if what not in get_args(Dump):
        raise UserError(f"what may be {', '.join(get_args(Dump))}, not {what!r}")
    source = Source.of(model, class_name, libraries, units, data, allow_external)
    if what == "flat":
        return dump_flat(flatten(Library(source.path, source.access), source.name, units=units))
    path = list(source.path)
    return dump_structure(translate(source.name, search_path=path, units=units, access=source.access)[0], what)


def load(
    model: str | Path,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    parameters: Mapping[str, float] | None = None,
    units: Units = "error",
    data: Iterable[str | Path] = (),
    allow_external: bool = False,
) -> Model:
    """Translate and compile a model; at once where nothing that it was made from has changed.

    `model` is a full name (`Lacuna.` may be left out), a .mo file, or the folder of a package; `class_name` picks a
    class in a file or package. `libraries` are folders of packages, folders around them, or .mo files; MODELICAPATH
    and the package Lacuna come after them. `parameters` are values other than declared, in their units, for every run.
    `data` are folders for files of data, beside those of the model and the libraries; with `allow_external` the C that
    a model's external functions name is compiled into it, and runs with your rights.
    Raises Diagnostic with file, line and hint where the model is wrong, UserError for an unknown parameter.
    """
    source = Source.of(model, class_name, libraries, units, data, allow_external)
    try:
        return Model(source, source.compiled()).with_parameters(parameters or {})
    except Diagnostic as finding:
        if finding.code != NO_VALUE or not parameters:
            raise
        values = as_numbers(parameters, {})
        return Model(source, source.compiled(values), values).with_parameters(parameters)


class Model:
    """A translated model. Read-only: runs in many threads may use it at once."""

    def __init__(
        self, source: Source, compiled: CompiledModel, fixed: Mapping[str, float] | None = None,
        values: Mapping[str, float] | None = None,
    ) -> None:  # fmt: skip
        self._source, self._compiled = source, compiled
        self._fixed, self._values = dict(fixed or {}), dict(values or {})  # part of the structure; set for every run
        self._model = runtime.Model(compiled.path)

    @property
    def name(self) -> str:
        """Full name of the class."""
        return self._model.name

    @property
    def variables(self) -> dict[str, runtime.Variable]:
        """Every variable by full name, in order of declaration, with unit, description, bounds and source line."""
        return self._model.variables

    @property
    def parameters(self) -> dict[str, runtime.Variable]:
        """The variables that `parameters` may set; `start` is the declared value."""
        return {n: v for n, v in self.variables.items() if v.kind == "parameter" and (v.settable or n in self._fixed)}

    @property
    def inputs(self) -> dict[str, runtime.Variable]:
        return self._model.inputs

    @property
    def states(self) -> dict[str, runtime.Variable]:
        return self._model.states

    @property
    def start_time(self) -> float:
        """s, of the model's experiment; so are `stop_time` (s), `tolerance` and `interval` (s, 0 where not given)."""
        return float(self._model.start_time)

    @property
    def stop_time(self) -> float:
        return float(self._model.stop_time)

    @property
    def tolerance(self) -> float:
        return float(self._model.tolerance)

    @property
    def interval(self) -> float:
        return float(self._model.interval)

    @property
    def warnings(self) -> list[str]:
        """Of the translation, each with file and line."""
        return [str(warning) for warning in self._compiled.report.warnings]

    @property
    def seconds(self) -> dict[str, float]:
        """Of each pass of the translation; empty where the model was compiled before."""
        return dict(self._compiled.report.seconds)

    @property
    def library(self) -> Path:
        """The compiled model, a shared library."""
        return Path(self._compiled.path)

    @property
    def request(self) -> tuple[Source, dict[str, float], dict[str, float]]:
        """What was loaded: its source, parameters that are part of the structure, and those set for every run."""
        return self._source, dict(self._fixed), dict(self._values)

    @property
    def translated(self) -> runtime.Model:
        """The model as the runtime has it, for sessions that run it again and again."""
        return self._model

    @cached_property
    def differentiated(self) -> runtime.Model:
        """The same with its derivatives, which runs with `sensitivities` need; translated when first asked for."""
        return runtime.Model(self._source.compiled(self._fixed, sensitivities=True).path)

    def run_at(
        self, times: np.ndarray, outputs: Sequence[str], inputs: Mapping[str, Input], progress: Progress | None = None
    ) -> runtime.Result:
        """A run with rows at `times` (s, [rows]) and nothing else."""
        self._refuse_parameters(inputs)
        begin, end = float(times[0]), float(times[-1])
        return runtime.simulate(
            self._model, parameters=self._values, inputs=as_inputs(inputs, self.variables), start=begin, stop=end,
            output_times=times, outputs=outputs, events=False,
            watch=watching(f"simulating {self.name}", begin, end, progress),
        )  # fmt: skip

    def with_parameters(self, parameters: Mapping[str, float]) -> Model:
        """The same model with other values; translated anew where some decide its structure, and what it has."""
        if not parameters:
            return self
        known = {n: v for n, v in self.variables.items() if v.kind == "parameter"}
        structural = as_numbers({n: v for n, v in parameters.items() if n in known and not known[n].settable}, known)
        if structural:
            fixed = self._fixed | structural
            compiled = self._source.compiled(fixed) if fixed != self._fixed else self._compiled
            others = {n: v for n, v in parameters.items() if n not in structural}
            return Model(self._source, compiled, fixed, self._values).with_parameters(others)
        for name in parameters:
            self._refuse_input(name)
            self._model.variable(name, "parameter", known)
        return Model(self._source, self._compiled, self._fixed, self._values | as_numbers(parameters, known))

    def _refuse_input(self, name: str) -> None:
        if name in self.inputs:
            raise UserError(f"{name} is an input of {self.name}, not a parameter: drive it by inputs, or -u {name}=...")
        if name in self.variables and self.variables[name].kind != "parameter":
            raise UserError(f"{name} of {self.name} is not to be set: equations give its value")

    def simulate(
        self,
        *,
        stop: float | None = None,
        start: float | None = None,
        inputs: Mapping[str, Input] | None = None,
        parameters: Mapping[str, float] | None = None,
        initial: Mapping[str, float] | None = None,
        solver: Solver = "ida",
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        interval: float | None = None,
        outputs: Sequence[str] | None = None,
        event_rows: bool = False,
        locate_events: bool = True,
        sensitivities: Sequence[str] = (),
        progress: Progress | None = None,
    ) -> Result:
        """Simulate from `start` to `stop` (s; default: the model's experiment).

        `inputs` drive inputs by constants, (times, values) or recordings; those not named keep their start value.
        `parameters` replace declared values, `initial` the start values of states. Rows come every `interval` (s; by
        default the model's own, else 500 over the run) and at the stop, with `event_rows` also around each event.
        `outputs` restricts what is recorded. `rtol`: relative tolerance (default: the model's, else 1e-6); `atol`:
        absolute, for each unit of a nominal value (0.01 rtol). `step` (s): of fixed-step solvers, which without
        `locate_events` take events at its end. `sensitivities` names parameters and states (initial values) by which
        outputs are differentiated (ida, dopri5). `progress` is told how far it is; what it raises ends the run.

        Raises UserError or SimulationError for what cannot be used, IncompleteRun (with its rows) where it ends early.
        """
        check_kinds(inputs=inputs, parameters=parameters, initial=initial, outputs=outputs, sensitivities=sensitivities)
        _refuse_settings(solver, start=start, stop=stop, rtol=rtol, atol=atol, step=step, interval=interval)
        model, outputs = self.with_parameters(parameters or {}), outputs and list(dict.fromkeys(outputs))
        begin, end = model._span(start, stop)
        model._refuse_parameters(inputs or {})
        clock, starts = time.perf_counter(), as_numbers(initial or {}, model.variables)
        run = runtime.simulate(
            model.differentiated if sensitivities else model._model, parameters=model._values,
            inputs=as_inputs(inputs or {}, model.variables), initial=starts, start=begin, stop=end, solver=solver,
            rtol=rtol, atol=atol, step=step, locate_events=locate_events, outputs=outputs, events=event_rows,
            interval=interval if interval is not None else model.interval or (end - begin) / POINTS,
            sensitivities=sensitivities, watch=watching(f"simulating {self.name}", begin, end, progress),
        )  # fmt: skip
        result = Result(run, None if outputs is None else list(outputs), time.perf_counter() - clock)
        result.warnings += [*uncovered(inputs or {}, begin, end), *assumed(inputs or {}, model.variables)]
        if not result.complete:
            raise IncompleteRun(result)
        (progress or silent)(f"simulating {self.name}", 1.0)
        return result

    def _span(self, start: float | None, stop: float | None) -> tuple[float, float]:
        begin, end = self.start_time if start is None else start, self.stop_time if stop is None else stop
        if not -np.inf < begin <= end < np.inf:
            raise UserError(f"a run of {self.name} cannot begin at {begin:g} s and end at {end:g} s")
        if not end - begin < np.inf:
            raise UserError(f"a run of {self.name} from {begin:g} s to {end:g} s is longer than any number of seconds")
        return begin, end

    def _refuse_parameters(self, inputs: Iterable[str]) -> None:
        for name in inputs:
            if name in self.parameters:
                raise UserError(f"{name} is a parameter of {self.name}, not an input: set it by parameters, or -p")

    def __reduce__(self) -> tuple[Callable[..., Model], tuple[Source, dict[str, float], dict[str, float]]]:
        """For other processes: loaded there again, from what was compiled here."""
        return _loaded, self.request

    def __repr__(self) -> str:
        return f"<Model {self.name}: {self._model.n_states} states, {len(self.variables)} variables>"

    def _repr_html_(self) -> str:
        head = ("parameter", "value", "unit", "")
        rows = [(n, self._values.get(n, v.start), v.unit, v.description) for n, v in self.parameters.items()]
        driven = [(n, v.unit, v.description) for n, v in self.inputs.items()]
        size = f"{self.name}: {self._model.n_states} states, {len(self.variables)} variables"
        return page(size, table(head, rows), *([table(("input", "unit", ""), driven)] if driven else []))


def _loaded(source: Source, fixed: Mapping[str, float], values: Mapping[str, float]) -> Model:
    return Model(source, source.compiled(fixed), fixed, values)


def _refuse_settings(solver: str, **given: float | None) -> None:
    """Raises UserError for what is no number, such as "2", and for a step that the solver does not take."""
    as_numbers({name: value for name, value in given.items() if value is not None}, {})
    if not isinstance(solver, str):
        raise UserError(f"solver is one of {', '.join((*runtime.ADAPTIVE, *runtime.FIXED_STEP))}, not {solver!r}")
    if given["step"] is not None and solver in runtime.ADAPTIVE:
        raise UserError(f"{solver} chooses its steps itself: a step is for {' and '.join(runtime.FIXED_STEP)}")
