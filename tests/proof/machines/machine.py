"""A kind of machine: its believed model as Modelica text, and its equations once more, in Python, with room for what is
concealed. Nothing here knows the tool: the truth is integrated by classical Runge-Kutta at a fixed step.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

Values = Mapping[str, np.ndarray | float]
# x: states by name, u: inputs, p: parameters, e: concealed efforts by place (0 where there is none)
Rates = Callable[[Values, Values, Values, Values], dict[str, np.ndarray]]


@dataclass(frozen=True)
class Parameter:
    """A believed value, its unit, and the believed relative 1-sigma (0: exact)."""

    value: float
    unit: str
    sigma: float


@dataclass(frozen=True)
class Input:
    """An input's unit and the range that it is driven over."""

    unit: str
    low: float
    high: float


@dataclass(frozen=True)
class Output:
    """A recorded quantity: the model's variable, its unit, and how the truth reads it (x, u, p, e)."""

    variable: str
    unit: str
    read: Callable[[Values, Values, Values, Values], np.ndarray]


@dataclass(frozen=True)
class Hidden:
    """What is concealed at a `place` of the rates: an effort of size q, with states of its own where `rate` is given.

    `law(x, u, p, q)` is the effort; with a state of its own that is x["z"], and `rate` its derivative.
    """

    name: str
    place: str
    law: Callable[[Values, Values, Values, float], np.ndarray]
    size: float
    accept: tuple[str, ...]
    text: str
    rate: Callable[[Values, Values, Values, float], np.ndarray] | None = None


@dataclass(frozen=True)
class Machine:
    """One kind of machine; `model` has %parameters% where its declarations go."""

    name: str
    domain: str
    style: str  # flat | own connectors | library
    model: str
    parameters: Mapping[str, Parameter]
    inputs: Mapping[str, Input]
    outputs: Mapping[str, Output]
    start: Mapping[str, float]
    rates: Rates
    hidden: tuple[Hidden, ...]
    period: float
    substeps: int = 2
    samples: int = 700
    extra: Mapping[str, float] = field(default_factory=dict)
    inner: str = ""  # the class in the file, where it is not the file's own

    def text(self) -> str:
        """The believed model, as its user wrote it."""
        lines = [
            f'  parameter Real {n}(unit="{p.unit}"{", min=0" if p.value > 0 else ""}) = {p.value:g};'
            for n, p in self.parameters.items()
        ]
        return self.model.strip("\n").replace("%parameters%", "\n".join(lines)) + "\n"


def simulate(
    machine: Machine, parameters: Values, drive: Mapping[str, np.ndarray], hidden: tuple[tuple[Hidden, float], ...] = ()
) -> dict[str, np.ndarray]:
    """Outputs (samples, batch) for inputs (samples, batch), linear between samples."""
    samples, batch = next(iter(drive.values())).shape
    states = [*machine.start, *(f"z{k}" for k, (h, _) in enumerate(hidden) if h.rate)]
    x = np.array([np.full(batch, machine.start.get(s, 0.0)) for s in states])
    step = machine.period / machine.substeps

    def efforts(s: dict, u: dict) -> dict[str, np.ndarray]:
        total: dict[str, np.ndarray] = dict.fromkeys((h.place for h, _ in hidden), 0.0)
        for k, (h, q) in enumerate(hidden):
            seen = s | {"z": s[f"z{k}"]} if h.rate else s
            total[h.place] = total[h.place] + h.law(seen, u, parameters, q)
        return {**dict.fromkeys(machine.start, 0.0), "out": 0.0, **total}

    def rates(x: np.ndarray, u: dict) -> np.ndarray:
        s = dict(zip(states, x, strict=True))
        found = machine.rates(s, u, parameters, efforts(s, u))
        for k, (h, q) in enumerate(hidden):
            if h.rate:
                found[f"z{k}"] = h.rate(s | {"z": s[f"z{k}"]}, u, parameters, q)
        return np.array([found[n] + np.zeros(batch) for n in states])

    def driven(k: int, share: float) -> dict:
        return {n: (1 - share) * v[k] + share * v[min(k + 1, samples - 1)] for n, v in drive.items()}

    recorded = {n: np.empty((samples, batch)) for n in machine.outputs}
    for k in range(samples):
        s, u = dict(zip(states, x, strict=True)), driven(k, 0.0)
        for n, output in machine.outputs.items():
            recorded[n][k] = output.read(s, u, parameters, efforts(s, u))
        for j in range(machine.substeps if k < samples - 1 else 0):
            at, middle, end = (driven(k, (j + c) / machine.substeps) for c in (0.0, 0.5, 1.0))
            a = rates(x, at)
            b = rates(x + step / 2 * a, middle)
            c = rates(x + step / 2 * b, middle)
            d = rates(x + step * c, end)
            x = x + step / 6 * (a + 2 * b + 2 * c + d)
    return recorded
