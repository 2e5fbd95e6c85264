"""A generated model and its tables: variables, equations, experiment."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
import weakref

from lacuna.runtime.errors import SimulationError, UnknownNameError
from lacuna.runtime.library import OF_TIME, STORAGE, TYPES, library

MESSAGE_SIZE = 600
CARRIER = (
    "new "  # begins the name of what carries a value to another variable (codegen/flatten/equations/algorithms.py)
)


@dataclass(frozen=True, slots=True)
class Variable:
    """One row of the model's variable table. An alias shares `storage` and `index` with what it equals."""

    name: str
    unit: str
    description: str
    kind: str  # state | algebraic | discrete | parameter | input | derivative
    type: str  # Real | Integer | Boolean
    start: float  # of a settable parameter: its declared value
    min: float  # -inf where not given
    max: float
    nominal: float  # 0 where not given
    settable: bool  # a parameter that may be given another value
    is_output: bool
    file: str
    line: int
    row: int
    index: int
    sign: int  # -1: a negated alias
    inferred_unit: str = ""  # what the equations say where no unit is declared
    is_parameter: bool = False  # declared as a parameter or constant; else a variable, though parameters may decide it

    @property
    def shown_unit(self) -> str:
        """Declared or inferred; "" where neither."""
        return self.unit or self.inferred_unit

    @property
    def storage(self) -> str:
        return self.kind


@dataclass(frozen=True, slots=True)
class Equation:
    """An equation or relation as written in the model."""

    text: str
    file: str
    line: int
    origin: str  # component path


def _text(value: bytes | None) -> str:
    return (value or b"").decode("utf-8", "replace")


def _equation(row) -> Equation:
    return Equation(_text(row.text), _text(row.file), row.line, _text(row.origin))


class Model:
    """A generated model. Read-only: many sessions, in many threads, may use it at once.

    Raises SimulationError where `path` is not a generated model of this ABI.
    """

    def __init__(self, path: str | Path):
        lib = library()
        message = ctypes.create_string_buffer(MESSAGE_SIZE)
        self.path = Path(path)
        self.handle = lib.rt_model_open(str(self.path.resolve()).encode(), message, MESSAGE_SIZE)
        if not self.handle:
            raise SimulationError(_text(message.value))
        weakref.finalize(self, lib.rt_model_close, self.handle)
        self._descriptor = d = lib.rt_model_descriptor(self.handle).contents
        self.name, self.hash = _text(d.name), _text(d.hash)
        self.start_time, self.stop_time = d.start_time, d.stop_time
        self.tolerance, self.interval = d.tolerance, d.interval
        self.n_parameters, self.n_states, self.n_relations = d.n_p, d.n_x, d.n_rel

    def __repr__(self) -> str:
        return f"<Model {self.name}: {self.n_states} states, {len(self.variables)} variables>"

    @cached_property
    def variables(self) -> dict[str, Variable]:
        """All variables by full name, in order of declaration."""
        d = self._descriptor
        rows = (self._variable(i, d.variables[i]) for i in range(d.n_variables))
        return {v.name: v for v in rows}

    def _variable(self, row: int, v) -> Variable:
        kind = STORAGE[v.storage]
        start = self._descriptor.p_start[v.index] * v.sign if kind == "parameter" else v.start
        return Variable(
            _text(v.name), _text(v.unit), _text(v.description), kind, TYPES[v.type], start, v.min, v.max, v.nominal,
            bool(v.settable), bool(v.is_output), _text(v.file), v.line, row, v.index, v.sign, _text(v.inferred_unit),
            bool(v.is_parameter),
        )  # fmt: skip

    @cached_property
    def parameters(self) -> dict[str, Variable]:
        """The parameters that may be given another value."""
        return {n: v for n, v in self.variables.items() if v.kind == "parameter" and v.settable}

    @cached_property
    def inputs(self) -> dict[str, Variable]:
        return {n: v for n, v in self.variables.items() if v.kind == "input"}

    @cached_property
    def states(self) -> dict[str, Variable]:
        return {n: v for n, v in self.variables.items() if v.kind == "state"}

    @cached_property
    def declared(self) -> list[str]:
        """Names of all variables that are not declared as parameters or constants: those that equal another one, and
        those that parameters alone decide, too."""
        return [name for name, v in self.variables.items() if not v.is_parameter and not name.startswith(CARRIER)]

    @cached_property
    def recordable(self) -> list[str]:
        """Everything that may change with time, each once: of several aliases the first stands for all. What only
        carries a value within an event, and has no name that a modeller can write, is left out."""
        first: dict[tuple[str, int], str] = {}
        for name, v in self.variables.items():
            if v.kind != "parameter" and not name.startswith(CARRIER):
                first.setdefault((v.kind, v.index), name)
        return list(first.values())

    @cached_property
    def equations(self) -> list[Equation]:
        return [_equation(self._descriptor.equations[i]) for i in range(self._descriptor.n_equations)]

    @cached_property
    def relations(self) -> list[Equation]:
        """The relations whose switching is an event, as indexed by the event log."""
        return [_equation(self._descriptor.relations[i].source) for i in range(self._descriptor.n_rel)]

    @cached_property
    def time_relations(self) -> list[bool]:
        """For each relation, whether it depends on time, parameters and discretes alone: no root switches it."""
        return [bool(self._descriptor.relations[i].kind & OF_TIME) for i in range(self._descriptor.n_rel)]

    @cached_property
    def messages(self) -> list[str]:
        """Messages of the model's terminate() calls, as indexed by the event log."""
        return [_text(self._descriptor.messages[i]) for i in range(self._descriptor.n_messages)]

    def variable(self, name: str, what: str = "variable", among: dict[str, Variable] | None = None) -> Variable:
        """The variable called `name` among `among` (default all). Raises UnknownNameError with the nearest names."""
        valid = self.variables if among is None else among
        found = valid.get(name)
        if found is None:
            raise UnknownNameError(what, name, valid, f"model {self.name}")
        return found
