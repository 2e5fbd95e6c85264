"""Where each variable of a model is kept: the arrays and indices of the ABI."""

from __future__ import annotations

from dataclasses import dataclass

from lacuna.codegen import flat
from lacuna.codegen.structure.system import System
from lacuna.codegen.symbolic.expr import Expr


@dataclass(frozen=True)
class Slot:
    """array is p, u, x, v or d of the ABI."""

    array: str
    index: int


class Storage:
    """Slots of all variables that are left after alias elimination."""

    def __init__(self, system: System):
        model = system.model
        algebraic, state = set(system.algebraics), set(system.states)
        self.parameters: list[str] = []
        self.inputs: list[str] = []
        self.discretes: list[str] = []
        self.states, self.algebraics = system.states, system.algebraics
        for v in model.variables.values():
            if v.variability in (flat.CONSTANT, flat.PARAMETER):
                self.parameters.append(v.name)
            elif v.causality == "input":
                self.inputs.append(v.name)
            elif v.name not in algebraic and v.name not in state and v.variability == flat.DISCRETE:
                self.discretes.append(v.name)
        groups = {"p": self.parameters, "u": self.inputs, "x": self.states, "v": self.algebraics, "d": self.discretes}
        self._slots = {name: Slot(array, k) for array, names in groups.items() for k, name in enumerate(names)}

    def slot(self, name: str) -> Slot | None:
        return self._slots.get(name)

    def is_discrete(self, n: Expr) -> bool:
        slot = self._slots.get(str(n.value)) if n.op == "var" else None
        return slot is not None and slot.array == "d"

    def frozen(self, n: Expr) -> str | None:
        """C text of a leaf that does not change within a callback: p, u, d, pre, rel, tick."""
        if n.op == "rel":
            return f"m->rel[{n.value}]"
        if n.op == "tick":
            return f"m->tick[{n.value}]"
        if n.op == "pre":
            slot = self._slots[str(n.args[0].value)]
            return f"m->pre_d[{slot.index}]" if slot.array == "d" else f"m->{slot.array}[{slot.index}]"
        slot = self._slots.get(str(n.value)) if n.op == "var" else None
        return f"m->{slot.array}[{slot.index}]" if slot and slot.array in "pud" else None

    def point(self, n: Expr) -> str | None:
        """C text of a leaf at a complete point (x, xdot, v)."""
        if n.op == "der":
            return f"xdot[{self._slots[str(n.args[0].value)].index}]"
        slot = self._slots.get(str(n.value)) if n.op == "var" else None
        return f"{slot.array}[{slot.index}]" if slot and slot.array in "xv" else self.frozen(n)

    def moving(self, n: Expr) -> str | None:
        """C text of a leaf where states stand for their rates: what else is known is what the point keeps."""
        text = self.point(n)
        return f"m->{text}" if text and text.startswith(("v", "xdot")) else text

    def explicit(self, n: Expr) -> str | None:
        """C text of a leaf where only the states are known."""
        slot = self._slots.get(str(n.value)) if n.op == "var" else None
        return f"x[{slot.index}]" if slot and slot.array == "x" else self.frozen(n)

    def residual(self, n: Expr, tears: list[Expr]) -> str | None:
        """C text of a leaf of the residual form, y = [x; tears] and yp."""
        if n.op == "der":
            return f"yp[{self._slots[str(n.args[0].value)].index}]"
        if n in tears:
            return f"y[{len(self.states) + tears.index(n)}]"
        slot = self._slots.get(str(n.value)) if n.op == "var" else None
        return f"y[{slot.index}]" if slot and slot.array == "x" else self.frozen(n)

    def place(self, unknown: Expr) -> str:
        """The element of x, v or xdot that keeps an unknown: `v[3]`, `xdot[0]`."""
        text = self.point(unknown)
        assert text is not None, unknown
        return text
