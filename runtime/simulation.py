"""Sessions and runs: from a model, parameters and inputs to a Result."""

from __future__ import annotations

import _signal  # signal without its enumerations, which take longer than a short run
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
import ctypes
from dataclasses import dataclass
from functools import partial
from signal import SIGINT, default_int_handler
import sys
import threading
from typing import Literal
import weakref

import numpy as np

from lacuna.runtime.errors import SimulationError
from lacuna.runtime.library import INTERRUPTED, COptions, library
from lacuna.runtime.model import MESSAGE_SIZE, Model
from lacuna.runtime.result import Result

ADAPTIVE, FIXED_STEP = ("ida", "dopri5", "rodas4"), ("rk4", "euler")  # these need a step, those choose theirs
SOLVERS = (*ADAPTIVE, *FIXED_STEP)
_NEVER = INTERRUPTED()


@dataclass(frozen=True, eq=False)
class RecordedInput:
    """Samples that drive an input. `time` (s) increases strictly; the first and last value hold outside.

    Raises SimulationError where lengths differ or there are no samples.
    """

    time: np.ndarray
    values: np.ndarray
    interpolation: Literal["linear", "hold"] = "linear"

    def __post_init__(self):
        object.__setattr__(self, "time", np.ascontiguousarray(self.time, dtype=float))
        object.__setattr__(self, "values", np.ascontiguousarray(self.values, dtype=float))
        if self.time.ndim != 1 or self.time.shape != self.values.shape or not len(self.time):
            raise SimulationError("a recorded input needs as many values as times, and at least one")
        if self.interpolation not in ("linear", "hold"):
            raise SimulationError(f'interpolation is "linear" or "hold", not "{self.interpolation}"')


class Session:
    """A model set up with one solver, to be run again and again: nothing is allocated anew but the results.

    One session serves one thread at a time, and refuses another. `outputs` default to all variables that change with
    time. Rows are at `output_times`, or every `interval` seconds, or (interval 0) at the end of every step; by default
    the model's own interval. With `events`, a row before and one after each event is added. `locate_events=False`
    takes state and time events at the end of the step in which they fall, as fixed-step simulations usually do.
    A run that takes more than `max_steps`, or does not get through a millionth of its time in `patience` seconds of
    computing (default 60), or does so in steps of which it would take more than 1e10, ends with a failure.
    `atol` is per unit of a variable's nominal value.
    `checks=False` leaves out the look at each accepted point for numbers that are not finite and divisors at zero.
    `sensitivities` names parameters, and states for their initial values, by which every output is differentiated
    (`Result.sensitivity`); the model must have been compiled with them, and the solver be dopri5 or ida.
    Raises SimulationError for what cannot be used.
    """

    def __init__(
        self,
        model: Model,
        *,
        solver: str = "ida",
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        max_step: float | None = None,
        max_steps: int | None = None,
        patience: float | None = None,
        checks: bool = True,
        locate_events: bool = True,
        outputs: Sequence[str] | None = None,
        output_times: np.ndarray | None = None,
        interval: float | None = None,
        events: bool = True,
        inputs: Mapping[str, RecordedInput | float] | None = None,
        sensitivities: Sequence[str] = (),
    ):
        self._lib, self.model = library(), model
        given = {"rtol": rtol, "atol": atol, "step": step, "max_step": max_step, "patience": patience}
        for name, value in given.items():
            if value is not None and not 0 < value < float("inf"):
                raise SimulationError(f"{name} must be greater than zero, not {value}")
        self.settings = {"solver": solver, "rtol": rtol, "atol": atol, "step": step, "max_step": max_step,
                         "locate_events": locate_events}  # fmt: skip
        limits = (rtol or 0, atol or 0, step or 0, max_step or 0)
        options = COptions(solver.encode(), *limits, locate_events, events, max_steps or 0, not checks, patience or 0)
        message = ctypes.create_string_buffer(MESSAGE_SIZE)
        self._handle = self._lib.rt_session_new(model.handle, ctypes.byref(options), message, MESSAGE_SIZE)
        if not self._handle:
            raise SimulationError(message.value.decode("utf-8", "replace"))
        weakref.finalize(self, self._lib.rt_session_free, self._handle)
        self.settings["rtol"], self.settings["atol"] = self._tolerances()
        self._inputs: dict[str, RecordedInput] = {}
        self._used = threading.Lock()
        self._set_outputs(model.recordable if outputs is None else outputs)
        self._set_grid(output_times, model.interval if interval is None else interval)
        self.set_inputs(inputs or {})
        self._set_sensitivities(sensitivities)

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Raises SimulationError where another thread, or what watches a run, is using the session."""
        if not self._used.acquire(blocking=False):
            raise SimulationError("this session is in use: a thread, and what is run within a run, needs its own")
        try:
            yield
        finally:
            self._used.release()

    def _tolerances(self) -> tuple[float, float]:
        """Those in force, given or not."""
        rtol, atol = ctypes.c_double(), ctypes.c_double()
        self._lib.rt_session_tolerances(self._handle, ctypes.byref(rtol), ctypes.byref(atol))
        return rtol.value, atol.value

    def _check(self, status: int) -> None:
        if status:
            failure = self._lib.rt_session_failure(self._handle).contents
            raise SimulationError(failure.message.decode("utf-8", "replace"))

    def _set_outputs(self, names: Sequence[str]) -> None:
        rows = [self.model.variable(name).row for name in names if name != "time"]
        self._columns = [name for name in names if name != "time"]
        self._check(self._lib.rt_session_outputs(self._handle, len(rows), (ctypes.c_int * len(rows))(*rows)))

    def _set_grid(self, times: np.ndarray | None, interval: float) -> None:
        self._times = None if times is None else np.ascontiguousarray(times, dtype=float)
        count, address = (0, None) if times is None else (self._times.size, self._times.ctypes.data)
        self._check(self._lib.rt_session_grid(self._handle, count, address, interval))

    def _set_sensitivities(self, names: Sequence[str]) -> None:
        self._sensitivities = tuple(names)
        rows = [self.model.variable(name, "parameter or state", self.model.variables).row for name in names]
        self._check(self._lib.rt_session_sensitivities(self._handle, len(rows), (ctypes.c_int * len(rows))(*rows)))

    def set_inputs(self, inputs: Mapping[str, RecordedInput | float]) -> None:
        """Drive inputs by recordings or constants; inputs not named keep what they had (at first their start value).
        Integers and Booleans are held between samples, whatever the recording says: nothing lies between them."""
        with self._alone():
            self._drive(inputs)

    def _drive(self, inputs: Mapping[str, RecordedInput | float]) -> None:
        for name, given in inputs.items():
            if self._inputs.get(name) is given:
                continue
            variable = self.model.variable(name, "input", self.model.inputs)
            recorded = given if isinstance(given, RecordedInput) else RecordedInput([0.0], [given], "hold")
            held = recorded.interpolation == "hold" or variable.type != "Real"
            self._check(
                self._lib.rt_session_input(
                    self._handle, variable.row, recorded.time.size, recorded.time.ctypes.data,
                    recorded.values.ctypes.data, held,
                )
            )  # fmt: skip
            self._inputs[name] = recorded  # keeps the arrays alive that the session borrows, once it does

    def set_parameters(self, values: Mapping[str, float]) -> None:
        """Take these, and what is declared for all others. Raises SimulationError for one that is not of its type, or
        outside of its bounds."""
        with self._alone():
            self._take(values)

    def _take(self, values: Mapping[str, float]) -> None:
        self._assign(self._lib.rt_session_parameters, values, "parameter that may be set", self.model.parameters)

    def _assign(self, function, values: Mapping[str, float], what: str, among) -> None:
        n = len(values)
        if not n:
            self._check(function(self._handle, 0, None, None))
            return
        rows = [self.model.variable(name, what, among).row for name in values]
        self._check(function(self._handle, n, (ctypes.c_int * n)(*rows), (ctypes.c_double * n)(*values.values())))

    def run(
        self,
        parameters: Mapping[str, float] | None = None,
        inputs: Mapping[str, RecordedInput | float] | None = None,
        initial: Mapping[str, float] | None = None,
        start: float | None = None,
        stop: float | None = None,
        watch: Callable[[float], object] | None = None,
    ) -> Result:
        """Simulate from `start` to `stop` (s; default the model's experiment).

        `parameters` replace declared values, `initial` replaces the values of states that the initial equations give.
        `watch` is called some ten times a second with the time (s) reached; what it raises ends the run.
        A run that fails gives an incomplete Result with `failure`; unknown names and values outside bounds raise
        SimulationError.
        """
        with self._alone():
            return self._run(parameters or {}, inputs or {}, initial or {}, start, stop, watch)

    def _run(self, parameters, inputs, initial, start, stop, watch) -> Result:
        model, lib = self.model, self._lib
        self._take(parameters)
        self._assign(lib.rt_session_initial, initial, "state", model.states)
        self._drive(inputs)
        handle = None
        try:
            with _watched(lib, self._handle, watch):
                handle = lib.rt_session_run(
                    self._handle,
                    model.start_time if start is None else start,
                    model.stop_time if stop is None else stop,
                )
        except BaseException:
            lib.rt_result_free(handle)
            raise
        if not handle:
            raise MemoryError("no memory for the result of a simulation")
        return Result(
            model, handle, self._columns, self.settings, partial(lib.rt_result_free, handle), self._sensitivities
        )


@contextmanager
def _watched(lib: ctypes.CDLL, session: int, watch: Callable[[float], object] | None) -> Iterator[None]:
    """The runtime comes back to Python now and then: to tell `watch` the time, and for Ctrl-C, which is delivered to
    the main thread alone. Who has a handler of his own keeps it. What ended the run is raised after it."""
    hears = _hears_ctrl_c()
    if watch is None and not hears:
        yield
        return
    raised: list[BaseException] = []

    def look(time: float) -> int:
        try:
            if watch is not None and not raised:
                watch(time)
        except BaseException as error:
            raised.append(error)
        return len(raised)

    callback = INTERRUPTED(look)
    lib.rt_session_watch(session, callback)
    before = _signal.signal(SIGINT, lambda *_: raised.append(KeyboardInterrupt())) if hears else None
    try:
        with _kept_from_being_ignored(look, raised):
            yield
    finally:
        if hears:
            _signal.signal(SIGINT, before)
        lib.rt_session_watch(session, _NEVER)
    if raised:
        raise raised[0]


@contextmanager
def _kept_from_being_ignored(callback: object, raised: list[BaseException]) -> Iterator[None]:
    """Handlers of other signals (an alarm's) run where the runtime comes back to Python, before `callback` has begun:
    what they raise there is nobody's to catch."""
    if not _is_main():
        yield
        return
    before = sys.unraisablehook

    def hook(unraisable: sys.UnraisableHookArgs) -> None:
        if unraisable.object is callback and unraisable.exc_value is not None:
            raised.append(unraisable.exc_value)
        else:
            before(unraisable)

    sys.unraisablehook = hook
    try:
        yield
    finally:
        sys.unraisablehook = before


def _is_main() -> bool:
    return threading.current_thread() is threading.main_thread()


def _hears_ctrl_c() -> bool:
    """This is the thread that signals come to, and nobody else has asked for this one."""
    return _is_main() and _signal.getsignal(SIGINT) is default_int_handler


def simulate(
    model: Model,
    *,
    parameters: Mapping[str, float] | None = None,
    inputs: Mapping[str, RecordedInput | float] | None = None,
    initial: Mapping[str, float] | None = None,
    start: float | None = None,
    stop: float | None = None,
    watch: Callable[[float], object] | None = None,
    **session,
) -> Result:
    """One run: Session(model, **session).run(...). Keep a Session where the same model is run many times."""
    return Session(model, **session).run(parameters, inputs, initial, start, stop, watch)
