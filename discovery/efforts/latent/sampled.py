"""What a sampled controller remembers, as states of the linear model: held between its samples, set anew at each.

Of a `when sample(...)` clause the assignments are a map from the states, what was held and the inputs to what is held
next; its derivatives are those of the assigned expressions, in their order, along the trajectory. Everything else that
events set is held as the trajectory has it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import DiscreteEquation
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import REAL, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import assigned, expressions
from lacuna.discovery.efforts.latent.flows import NUMBERS, flows
from lacuna.discovery.efforts.latent.numeric import Evaluator, NotNumeric, Value
from lacuna.discovery.efforts.places.sites import MOST

AT_ONCE = 1e-6  # of the interval of a recording, within which a tick and a sample are at one time
Rows = dict[str, np.ndarray]  # (n, states + memory + columns) of each variable: its derivatives


def remembered(prepared: Prepared) -> list[str]:
    """Real variables that ticks set; none where they are too many to follow."""
    if not prepared.samples:
        return []
    ticking = [w for w in _whens(prepared) if any(_ticks(prepared, c) for c, _ in w.branches)]
    names = dict.fromkeys(n for n in assigned(ticking) if n in prepared.storage.discretes)
    names = [n for n in names if prepared.model.variables[n].type == REAL]
    return names if len(names) <= MOST else []


def read_at_ticks(prepared: Prepared) -> set[str]:
    """Names of variables, and of rates as der(x), that the steps of events read."""
    found = {n for e in expressions(list(_whens(prepared))) for n in leaves(e)}
    found |= {n for s in prepared.events if isinstance(s, DiscreteEquation) for n in leaves(s.value)}
    return {f"der({n.args[0].value})" if n.op == "der" else str(n.value) for n in found}


def _whens(prepared: Prepared) -> Iterable[flat.When]:
    for step in prepared.events:
        if isinstance(step, flat.When):
            yield step
        elif isinstance(step, flat.Algorithm):
            yield from (s for s in step.statements if isinstance(s, flat.When))


def _ticks(prepared: Prepared, condition: Expr) -> bool:
    """Whether a condition is of a tick, or of a Boolean that is one."""
    equations = {s.target: s.value for s in prepared.events if isinstance(s, DiscreteEquation)}
    found = leaves(condition)
    named = (equations[str(n.value)] for n in found if n.op == "var" and str(n.value) in equations)
    return any(n.op == "tick" for n in found) or any(n.op == "tick" for e in named for n in leaves(e))


@dataclass
class Sampling:
    """The ticks of a model along a trajectory of n samples: when they come, and what each does, to first order."""

    prepared: Prepared
    memory: list[str]
    values: Evaluator  # along the trajectory
    known: Rows  # of states, memory, algebraic variables and rates, inputs
    time: np.ndarray
    _maps: dict[int, np.ndarray] = field(default_factory=dict)

    def ticks(self) -> list[tuple[float, int]]:
        """(time, number of the tick), in order, from the first sample of the trajectory to before its last. Raises
        NotNumeric where they are so many that to follow them takes long."""
        begin, end = float(self.time[0]), float(self.time[-1])
        near, found = AT_ONCE * float(np.median(np.diff(self.time))), []
        columns = next(iter(self.known.values())).shape[1]
        for number, (start, period) in enumerate(self.prepared.samples):
            first, step = (float(np.mean(self.values(e))) for e in (start, period))
            k = range(max(0, int(np.ceil((begin - near - first) / step))), int((end - near - first) / step) + 1)
            if (len(found) + len(k)) * columns > NUMBERS:
                raise NotNumeric("a controller looks too often to be followed")
            found += [(first + step * n, number) for n in k]
        return sorted(found)

    def map_of(self, number: int) -> np.ndarray:
        """(n, memory, states + memory + columns): what is held after a tick, by what was before it."""
        if number not in self._maps:
            rows, values = dict(self.known), {}
            for step in self.prepared.events:
                self._step(step, number, rows, values, np.ones(len(self.time), dtype=bool))
            self._maps[number] = np.stack([rows[n] for n in self.memory], axis=1)
        return self._maps[number]

    def _step(self, step: object, tick: int, rows: Rows, values: dict[str, Value], where: np.ndarray) -> None:
        """A step of an event at a tick, on the samples `where` it is taken."""
        if isinstance(step, DiscreteEquation | flat.Assign):
            self._assign(step.target, step.value, tick, rows, values, where)
        elif isinstance(step, flat.When | flat.If):
            left = where
            for condition, body in step.branches:
                holds = self._holds(condition, tick, values)
                for s in body if np.any(left & holds) else ():
                    self._step(s, tick, rows, values, left & holds)
                left = left & ~holds
        elif isinstance(step, flat.Algorithm):
            for s in step.statements:
                self._step(s, tick, rows, values, where)
        elif not isinstance(step, flat.Assert | flat.Terminate):
            raise NotNumeric(f"what {type(step).__name__} does at a tick cannot be linearised")

    def _holds(self, condition: Expr, tick: int, values: Mapping[str, Value]) -> np.ndarray:
        holds = np.broadcast_to(self._evaluator(tick, values)(condition), self.time.shape)
        return holds.astype(bool)

    def _evaluator(self, tick: int, values: Mapping[str, Value]) -> Evaluator:
        """Values at a tick: what has been assigned is new, what has not, as the trajectory has it."""

        def leaf(n: Expr) -> Value:
            if n.op == "tick":
                return n.value == tick
            if n.op in ("initial", "terminal"):
                return False
            if n.op == "var" and str(n.value) in values:
                return values[str(n.value)]
            if n.op == "pre" and n.type != REAL and str(n.args[0].value) in values:
                return False  # of a clock's Boolean: it was not ticking just before
            return self.values(n)

        return Evaluator(leaf)

    def _assign(
        self, target: str, value: Expr, tick: int, rows: Rows, values: dict[str, Value], where: np.ndarray
    ) -> None:  # fmt: skip
        evaluate = self._evaluator(tick, values)
        new = np.broadcast_to(evaluate(value), self.time.shape)
        if target in self.memory:
            found = np.zeros_like(rows[target])
            for n in leaves(value):
                row = self._row(n, rows)
                slope = partial(value, n) if row is not None else None
                if slope is not None:
                    found += np.broadcast_to(evaluate(slope), self.time.shape)[:, None] * row
            rows[target] = np.where(where[:, None], found, rows[target])
        values[target] = np.where(where, new, values.get(target, new))

    def _row(self, n: Expr, rows: Rows) -> np.ndarray | None:
        """Derivatives of a leaf: of what was before the tick, where it is pre(...)."""
        if n.op == "pre":
            return self.known.get(str(n.args[0].value))
        name = f"der({n.args[0].value})" if n.op == "der" else str(n.value) if n.op == "var" else ""
        return rows.get(name)


def through_ticks(
    rates: np.ndarray, time: np.ndarray, sampling: Sampling, states: int
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """(step (n-1, x, x), drive (n-1, x, b)) from sample to sample, x the states and the memory, `rates` (n, x, x + b)
    zero for the memory: flows between the ticks, and what those set. Raises NotNumeric where that cannot be said."""
    n, width = len(time), rates.shape[1]
    near = AT_ONCE * float(np.median(np.diff(time)))
    ticks = sampling.ticks()
    edges = np.array(sorted([*time.tolist(), *(t for t, _ in ticks)]))
    edges = edges[np.append(True, np.diff(edges) > near)]
    at: dict[int, list[int]] = {}
    for t, number in ticks:
        at.setdefault(int(np.searchsorted(edges, t - near)), []).append(number)
    owner = np.clip(np.searchsorted(time, edges[:-1] + 2 * near) - 1, 0, n - 2)
    step = np.repeat(np.eye(width)[None], n - 1, axis=0)
    drive = np.zeros((n - 1, width, rates.shape[2] - width))
    flow, source = flows(rates, owner, np.diff(edges))
    for k, interval in enumerate(owner):
        for number in at.get(k, ()):
            row = sampling.map_of(number)[interval]
            jump = np.eye(width)
            jump[states:] = row[:, :width]
            step[interval] = jump @ step[interval]
            drive[interval] = jump @ drive[interval]
            drive[interval, states:] += row[:, width:]
        step[interval] = flow[k] @ step[interval]
        drive[interval] = flow[k] @ drive[interval] + source[k]
    return step, drive
