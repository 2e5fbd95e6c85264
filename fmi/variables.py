"""The variables of an FMU: rows of the model's variable table with the roles that FMI gives them.

Value references (fmi/src/fmu.h): 0 time, 1 + row, then the derivatives of the states, then the event indicators, then
the states that no row stands for. An array has the value reference of its first element.
"""

from __future__ import annotations

from functools import cached_property

from lacuna.codegen import flat
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.structure.causal import Assignment
from lacuna.fmi.arrays import arrays_of, joined, states_of
from lacuna.fmi.errors import FmuError
from lacuna.fmi.variable import FmiVariable
import lacuna.runtime as runtime


class FmiVariables:
    """All variables of a model in the order of their value references, and the lists that FMI wants of them.

    `values`: settable parameters that start with another value than declared. `arrays`: an array is one variable, as
    in FMI 3.0; without, each element is one.
    """

    def __init__(self, model: runtime.Model, prepared: Prepared, values: dict[str, float], arrays: bool = False):
        self.model, self._prepared, self._values = model, prepared, values
        self._arrays = arrays_of(model.variables.values()) if arrays else []
        if "time" in model.variables:
            raise FmuError(f"{model.name} has a variable called time, which is the independent variable of an FMU")

    @cached_property
    def all(self) -> list[FmiVariable]:
        clock = FmiVariable("time", 0, "independent", "continuous", unit="s", description="time")
        rows = [self._row(v) for v in self.model.variables.values()]
        chosen = [v for v in self.states if v.reference > len(rows)]
        return joined([clock, *rows, *self._derivatives(), *self.indicators, *chosen], self._arrays)

    @cached_property
    def states(self) -> list[FmiVariable]:
        """The variable that is each state itself, in the order of the states. One that events choose anew stands now
        for one variable and now for another, so it has a name of its own, in quotes, which no variable's can be.
        Of several variables that are one state, an element of an array of states comes before one that is in no array,
        and that before one whose array has others than states in it."""
        vectors = {v.name for array in self._arrays if states_of(array) for v in array.elements}
        mixed = {v.name for array in self._arrays for v in array.elements} - vectors
        candidates = sorted(self.model.states.values(), key=lambda v: (v.name in mixed) - (v.name in vectors))
        own = {v.index: v for v in reversed(candidates) if v.sign == 1}
        first = self._first_indicator + len(self.indicators)
        return [
            self._row(own[k]) if k in own else
            FmiVariable(f"'$state[{k + 1}]'", first + k, "local", "continuous", initial="calculated",
                        description="one of the variables that may be states here: events choose it anew")
            for k in range(self.model.n_states)
        ]  # fmt: skip

    @property
    def derivatives(self) -> list[FmiVariable]:
        return [v for v in self.all if v.derivative_of is not None]

    @property
    def outputs(self) -> list[FmiVariable]:
        return [v for v in self.all if v.causality == "output"]

    @property
    def initial_unknowns(self) -> list[FmiVariable]:
        """What FMI lists as solved for at the start: outputs, states, their derivatives, dependent parameters."""
        chosen = {v.reference for v in (*self.states, *self.derivatives)}
        return [
            v for v in self.all
            if v.initial == "calculated"
            and (v.reference in chosen or v.causality in ("output", "calculatedParameter"))
        ]  # fmt: skip

    @cached_property
    def _starting(self) -> dict[str, float]:
        """States that simply start at a number: that an importer may set."""
        steps = self._prepared.initial.steps
        given = {str(s.unknown.value): s.row.source.rhs for s in steps
                 if isinstance(s, Assignment) and s.row.source.text.startswith("start of")}  # fmt: skip
        return {name: float(value.value) for name, value in given.items() if value.op == "const"}

    @property
    def starting(self) -> list[int]:
        """Rows of these states in the table of variables, ascending."""
        return sorted(v.row for v in self.model.variables.values() if v.kind == "state" and v.name in self._starting)

    def _row(self, v: runtime.Variable) -> FmiVariable:
        declared = self._prepared.declared.variables[v.name]
        common = {
            "name": v.name, "reference": 1 + v.row, "type": v.type, "unit": v.shown_unit, "quantity": declared.quantity,
            "description": _description(v, declared), "nominal": v.nominal,
        }  # fmt: skip
        return FmiVariable(**common, **self._role(v, declared))

    def _role(self, v: runtime.Variable, declared: flat.Variable) -> dict[str, object]:
        changes = "continuous" if v.type == "Real" and v.kind != "discrete" else "discrete"
        bounds = {"min": v.min, "max": v.max}
        if declared.causality == "input":
            return {"causality": "input", "variability": changes, "start": v.start, **bounds}
        if v.is_output:
            changes = "discrete" if v.kind == "parameter" else changes
            return {"causality": "output", "variability": changes, **self._start_of(v)}
        if v.kind == "parameter" and v.settable and v.is_parameter:
            start = self._values.get(v.name, v.start)
            return {"causality": "parameter", "variability": "tunable", "initial": "exact", "start": start, **bounds}
        if v.kind == "parameter":
            causality = "calculatedParameter" if v.is_parameter else "local"
            return {"causality": causality, "variability": "tunable", "initial": "calculated"}
        return {"causality": "local", "variability": changes, **self._start_of(v)}

    def _start_of(self, v: runtime.Variable) -> dict[str, object]:
        if v.kind == "state" and v.name in self._starting:
            return {"initial": "exact", "start": self._starting[v.name]}
        return {"initial": "calculated"}

    def _derivatives(self) -> list[FmiVariable]:
        first = 1 + len(self.model.variables)
        return [
            FmiVariable(
                f"der({v.name})", first + k, "local", "continuous", initial="calculated",
                unit=_per_second(v.unit), description=f"derivative of {v.name} by time", derivative_of=v.reference,
            )
            for k, v in enumerate(self.states)
        ]  # fmt: skip

    @property
    def _first_indicator(self) -> int:
        return 1 + len(self.model.variables) + self.model.n_states

    @cached_property
    def indicators(self) -> list[FmiVariable]:
        switched = [
            r for r, is_time in zip(self.model.relations, self.model.time_relations, strict=True) if not is_time
        ]
        first = self._first_indicator
        return [
            FmiVariable(f"eventIndicator[{k + 1}]", first + k, "local", "continuous", initial="calculated",
                        description=f"{r.text} ({r.origin})" if r.origin else r.text)
            for k, r in enumerate(switched)
        ]  # fmt: skip


def _description(v: runtime.Variable, declared: flat.Variable) -> str:
    if not declared.enumeration:
        return v.description
    literals = ", ".join(f"{k} {name}" for k, name in enumerate(declared.enumeration, 1))
    return f"{v.description} ({literals})".strip()


def _per_second(unit: str) -> str:
    """`unit` by seconds in Modelica's notation; "" where there is none."""
    if not unit:
        return ""
    above, slash, below = unit.partition("/")
    return f"{above}/({below.strip('()')}.s)" if slash else f"{above}/s"
