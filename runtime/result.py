"""What a run recorded: columns by name, event flags and log, counters, and why it ended early if it did."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
import ctypes
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lacuna.runtime.errors import SimulationError
from lacuna.runtime.library import EVENT_KINDS, FLAG_KINDS, STATUS, library
from lacuna.runtime.model import Model


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a run ended early. `message` is a complete sentence with time, variable or equation, and model line."""

    status: str  # one of library.STATUS
    time: float
    variable: str | None
    file: str | None
    line: int | None
    message: str

    def __str__(self) -> str:
        return self.message


@dataclass(frozen=True, slots=True)
class EventEntry:
    time: float
    kind: str  # state | time | sample | terminate
    index: int  # relation, relation, sample or message number
    direction: int  # of a relation: +1 it became true, -1 false
    text: str  # the relation as the model has it, in full names (or the call that jumped, or the message)
    file: str = ""  # of a relation: where it is written
    line: int = 0
    reach: float = 1.0  # of a state event: how far the guard was from zero since it last switched, in nominal values

    def __str__(self) -> str:
        became = {1: " becomes true", -1: " becomes false"}.get(self.direction, "")
        return f"{self.time:.9g} s: {self.text}{became}" + (f"  ({self.file}:{self.line})" if self.line else "")


@dataclass(frozen=True, slots=True)
class Flag:
    """A place where sensitivities are not what they seem.

    grazing: a relation only touches its threshold, and from there on they are not numbers; order: two events at one
    instant, as far as it is known, that move differently with a parameter; non_finite: a derivative is infinite;
    rounding: the model rounds values at events, and what depends on them has the derivative between two steps; fold:
    the branch that algebraic unknowns followed has ended; arrival: a when-clause read pre(y) where y follows what the
    event sets. From both on they are not numbers.
    """

    time: float
    kind: str  # grazing | order | non_finite | rounding | fold | arrival
    relations: tuple[str, ...]  # as written, those concerned

    def __str__(self) -> str:
        what = {
            "grazing": "a relation only touches its threshold; there are no sensitivities after it",
            "order": "two events at one instant move differently with a parameter",
            "non_finite": "a derivative is infinite; there are no sensitivities after it",
            "fold": "algebraic unknowns jump, their branch has ended; there are no sensitivities after it",
            "arrival": "pre(...) of what follows the event was read; there are no sensitivities after it",
            "rounding": "values rounded at events (converters, encoders) count as constant between two steps of theirs",
        }[self.kind]
        return f"{what} at time {self.time:.9g} s" + (f": {'; '.join(self.relations)}" if self.relations else "")


class _Owner:
    """Frees the C result when the last array that looks into it is gone."""

    def __init__(self, free: Callable[[], None]):
        self._free = free

    def __del__(self):
        self._free()


class _View:
    """Memory of a C result, in the form that numpy takes without copying, read-only; `owner` keeps it alive."""

    def __init__(self, owner: _Owner, address: int, rows: int, kind: str):
        self.owner = owner
        self.__array_interface__ = {"data": (address, True), "shape": (rows,), "typestr": kind, "version": 3}


class Result:
    """`result["name"]` is the column of a recorded variable (SI units), `result.time` the time of each row (s)."""

    def __init__(
        self,
        model: Model,
        handle: int,
        columns: Sequence[str],
        settings: dict,
        free: Callable[[], None],
        sensitivities: Sequence[str] = (),
    ):
        self.model, self.columns, self.settings = model, list(columns), dict(settings)
        self.sensitivities = tuple(sensitivities)
        self._lib, self._handle, self._owner = library(), handle, _Owner(free)
        self._rows = self._lib.rt_result_rows(handle)

    def __repr__(self) -> str:
        state = "complete" if self.complete else f"incomplete: {self.failure}"
        return f"<Result of {self.model.name}: {self._rows} rows of {len(self.columns)} variables, {state}>"

    def __reduce__(self) -> str | tuple:
        raise TypeError(
            f"a result of {self.model.name} looks into the memory of its run and cannot be copied or pickled: hand on "
            "what is needed of it, its columns or a table of them"
        )

    def __len__(self) -> int:
        return self._rows

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __contains__(self, name: object) -> bool:
        variable = self.model.variables.get(name)
        return name == "time" or (variable is not None and (variable.kind, variable.index) in self._places)

    def _array(self, address: int | None, kind: str) -> np.ndarray:
        if not self._rows:
            return np.empty(0, dtype=kind)
        return np.asarray(_View(self._owner, address, self._rows, kind))

    @cached_property
    def _places(self) -> dict[tuple[str, int], tuple[int, int]]:
        variables = [self.model.variables[name] for name in self.columns]
        return {(v.kind, v.index): (k, v.sign) for k, v in enumerate(variables)}

    @cached_property
    def time(self) -> np.ndarray:
        return self._array(self._lib.rt_result_time(self._handle), "<f8")

    @cached_property
    def event(self) -> np.ndarray:
        """True at rows recorded at an event: one before and one after it."""
        return self._array(self._lib.rt_result_event_flags(self._handle), "|u1").astype(bool)

    def __getitem__(self, name: str) -> np.ndarray:
        """The column of `name`, of a recorded variable that it is an alias of, or of a parameter (constant).

        Raises SimulationError where it is unknown (with the nearest names) or was not recorded.
        """
        if name == "time":
            return self.time
        if self.model.variable(name).kind == "parameter":
            return np.full(self._rows, self.parameters[name])
        place, sign = self._place(name)
        column = self._array(self._lib.rt_result_column(self._handle, place), "<f8")
        return column if sign > 0 else -column

    def _place(self, name: str) -> tuple[int, int]:
        """(column, sign) of a recorded variable."""
        variable = self.model.variable(name)
        place = self._places.get((variable.kind, variable.index))
        if place is None:
            raise SimulationError(f"{name} was not recorded; ask for it in `outputs`")
        return place[0], place[1] * variable.sign

    def sensitivity(self, output: str, parameter: str) -> np.ndarray:
        """d output / d parameter at the time of each row (SI units), at fixed time; of a state named in the place of a
        parameter, by its initial value. In rows at an event, the one before and the one after it.

        Not a number where it does not exist any more; `flags` says why. Raises SimulationError where the output was not
        recorded, or the run was not asked for this parameter.
        """
        if parameter not in self.sensitivities:
            raise SimulationError(f"no sensitivity with respect to {parameter}; ask for it in `sensitivities`")
        column, sign = self._place(output)
        address = self._lib.rt_result_sensitivity(self._handle, column, self.sensitivities.index(parameter))
        return sign * self._array(address, "<f8")

    @cached_property
    def margins(self) -> dict[str, float]:
        """How far each parameter may be changed, to first order, before two events of the run change their order (in
        the parameter's unit; infinite where no two instants move differently)."""
        address = self._lib.rt_result_margins(self._handle)
        count = len(self.sensitivities)
        values = (ctypes.c_double * count).from_address(address) if count else ()
        return dict(zip(self.sensitivities, values, strict=True))

    @cached_property
    def flags(self) -> list[Flag]:
        """Where the order of events is about to change: sensitivities after it hold on one side, or not at all."""
        count = ctypes.c_size_t()
        entries = self._lib.rt_result_flags(self._handle, ctypes.byref(count))
        return [self._flag(entries[i]) for i in range(count.value)]

    @cached_property
    def warnings(self) -> list[str]:
        """Asserts of level warning that were violated, each with the instant and the values of the first time; unknowns
        that the equations leave open."""
        count = ctypes.c_size_t()
        entries = self._lib.rt_result_warnings(self._handle, ctypes.byref(count))
        return [entries[i].decode() for i in range(count.value)]

    def _flag(self, f) -> Flag:
        named = tuple(self.model.relations[r].text for r in (f.relation, f.other) if r >= 0)
        return Flag(f.time, FLAG_KINDS[f.kind], named)

    @cached_property
    def parameters(self) -> dict[str, float]:
        """All parameters with the values used, dependent ones included."""
        count = self.model.n_parameters
        address = self._lib.rt_result_parameters(self._handle)
        values = (ctypes.c_double * count).from_address(address) if count else ()
        variables = self.model.variables.items()
        return {name: v.sign * values[v.index] for name, v in variables if v.kind == "parameter"}

    @cached_property
    def failure(self) -> Failure | None:
        f = self._lib.rt_result_failure(self._handle).contents
        if not f.status:
            return None
        name = next((n for n, v in self.model.variables.items() if v.row == f.variable), None)
        file = f.file.decode("utf-8", "replace") if f.file else None
        return Failure(STATUS[f.status], f.time, name, file, f.line or None, f.message.decode("utf-8", "replace"))

    @property
    def complete(self) -> bool:
        """The run reached its stop time, or terminate()."""
        return self.failure is None

    @cached_property
    def terminated(self) -> str | None:
        """The message of the terminate() that ended the run."""
        message = self._lib.rt_result_terminated(self._handle)
        return message.decode("utf-8", "replace") if message is not None else None

    @cached_property
    def counters(self) -> dict[str, int]:
        counters = self._lib.rt_result_counters(self._handle).contents
        return {name: getattr(counters, name) for name, _ in counters._fields_}

    @cached_property
    def event_log(self) -> list[EventEntry]:
        count = ctypes.c_size_t()
        entries = self._lib.rt_result_events(self._handle, ctypes.byref(count))
        return [self._entry(entries[i]) for i in range(count.value)]

    def _entry(self, e) -> EventEntry:
        kind = EVENT_KINDS[e.kind]
        if kind == "sample":
            return EventEntry(e.time, kind, e.index, e.direction, f"sample {e.index + 1}")
        if kind == "terminate":
            return EventEntry(e.time, kind, e.index, e.direction, self.model.messages[e.index])
        relation = self.model.relations[e.index]
        return EventEntry(e.time, kind, e.index, e.direction, relation.text, relation.file, relation.line, e.reach)
