"""What a run recorded: columns by name, event flags and log, counters, and why it ended early if it did."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
import ctypes
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lacuna.runtime.errors import SimulationError
from lacuna.runtime.library import EVENT_KINDS, STATUS, library
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
    text: str  # the relation as written, or the message


class _Owner:
    """Frees the C result when the last array that looks into it is gone."""

    def __init__(self, free: Callable[[], None]):
        self._free = free

    def __del__(self):
        self._free()


class _View:
    """Memory of a C result, in the form that numpy takes without copying; `owner` keeps it alive."""

    def __init__(self, owner: _Owner, address: int, rows: int, kind: str):
        self.owner = owner
        self.__array_interface__ = {"data": (address, False), "shape": (rows,), "typestr": kind, "version": 3}


class Result:
    """`result["name"]` is the column of a recorded variable (SI units), `result.time` the time of each row (s)."""

    def __init__(self, model: Model, handle: int, columns: Sequence[str], settings: dict, free: Callable[[], None]):
        self.model, self.columns, self.settings = model, list(columns), dict(settings)
        self._lib, self._handle, self._owner = library(), handle, _Owner(free)
        self._rows = self._lib.rt_result_rows(handle)

    def __repr__(self) -> str:
        state = "complete" if self.complete else f"incomplete: {self.failure}"
        return f"<Result of {self.model.name}: {self._rows} rows of {len(self.columns)} variables, {state}>"

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
        variable = self.model.variable(name)
        if variable.kind == "parameter":
            return np.full(self._rows, self.parameters[name])
        place = self._places.get((variable.kind, variable.index))
        if place is None:
            raise SimulationError(f"{name} was not recorded; ask for it in `outputs`")
        column = self._array(self._lib.rt_result_column(self._handle, place[0]), "<f8")
        return column if place[1] == variable.sign else -column

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
        name = list(self.model.variables)[f.variable] if f.variable >= 0 else None
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
            text = f"sample {e.index + 1}"
        elif kind == "terminate":
            text = self.model.messages[e.index]
        else:
            text = self.model.relations[e.index].text
        return EventEntry(e.time, kind, e.index, e.direction, text)
