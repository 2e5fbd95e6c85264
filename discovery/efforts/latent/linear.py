"""The equations of a model linearised along its trajectory: how states and outputs answer to inputs and parameters.

With rows F(u; x, p, q) = 0 in the unknowns u = (der(x), algebraic variables), inputs q and parameters p, the first
variation is M du + F_x dx + F_q dq + F_p dp = 0, M = dF/du. The derivatives are the symbolic ones of the generator,
evaluated at all samples of a trajectory at once; nothing is differenced.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import maximum_bipartite_matching

from lacuna.codegen import flat
from lacuna.codegen.compile import translate
from lacuna.codegen.symbolic.differentiate import Differentiator, partial
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, var
from lacuna.discovery.case.case_model import UNITS
from lacuna.discovery.case.cases import Recording
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.flows import blocks, flows
from lacuna.discovery.efforts.latent.numeric import Evaluator, NotNumeric, Value, finite, table
from lacuna.discovery.efforts.latent.sampled import Sampling, read_at_ticks, remembered, through_ticks
from lacuna.discovery.fit.machine import Machine
from lacuna.runtime import RecordedInput

ROUNDING = 1e-9  # of the terms of a sum that cancels: far above what double precision leaves, far below any answer
NEWTON = 4  # rounds at most; the trajectory solves the equations, only the derivatives are to be found


class Linear:
    """A machine's equations with their derivatives; `inputs` and `parameters` are what the columns belong to."""

    def __init__(self, machine: Machine, inputs: list[str], parameters: list[str]) -> None:
        self.machine, self.inputs, self.parameters = machine, inputs, parameters
        self.prepared, _ = translate(str(machine.path), search_path=machine.case.search_path, units=UNITS)
        system = self.prepared.system
        self.states, self.unknowns = system.states, system.unknowns
        residuals = [row.residual for row in system.rows]
        self.residuals = residuals
        self.memory = remembered(self.prepared)
        self._by_unknown = [_partials(r, self.unknowns) for r in residuals]
        self._by_state = [_partials(r, [var(n) for n in (*self.states, *self.memory)]) for r in residuals]
        probes = [var(self._kept(n)) for n in inputs]
        self._by_column = [_partials(r, probes) for r in residuals]
        for j, name in enumerate(parameters, len(inputs)):
            differentiate = self._by_parameter(name)
            for row, residual in zip(self._by_column, residuals, strict=True):
                if (d := differentiate(residual)) is not ZERO:
                    row[j] = d

    def _by_parameter(self, name: str) -> Differentiator:
        """Derivatives by a parameter, those through what is bound to it included."""
        variables = self.prepared.model.variables

        def seed(n: Expr) -> Expr:
            if n.op != "var":
                return ZERO
            if n.value == name:
                return ONE
            v = variables.get(str(n.value))
            bound = v is not None and v.variability in (flat.CONSTANT, flat.PARAMETER) and v.binding is not None
            return inner(v.binding) if bound else ZERO

        inner = Differentiator(seed)
        return inner

    def along(
        self, point: Mapping[str, float], recording: Recording, efforts: Mapping[str, RecordedInput] | None = None
    ) -> Along:
        """The linear model along the trajectory from `point`. Raises SimulationError, NotNumeric."""
        if not self.states and not self.memory:
            raise NotNumeric("it has no state: no effort lasts in it")
        values, fixed = self._trajectory(point, recording, efforts)
        solved = self._solved(values, fixed, recording.time)
        course = finite(solved, len(recording.time))
        n, columns = len(recording.time), len(self.inputs) + len(self.parameters)
        states = len(self.states) + len(self.memory)
        acting, outputs = slice(states, states + len(self.inputs)), len(self.machine.columns)
        answering = np.zeros((len(self.unknowns), len(self.inputs)), bool)
        answers = np.empty((n, len(self._told), states + columns))
        read, feed = np.empty((n, outputs, states)), np.empty((n, outputs, columns))
        for block in self._blocks(n):
            matrix = table(self._by_unknown, len(self.unknowns), course, block)
            right = [table(self._by_state, states, course, block), table(self._by_column, columns, course, block)]
            right = np.concatenate(right, axis=2)
            answer = -np.linalg.solve(matrix, right)
            answer[:, :, acting] = _without_rounding(answer[:, :, acting], matrix, right[:, :, acting]) * self._reached
            answering |= np.any(answer[:, :, acting] != 0, axis=0)
            answers[block] = answer[:, self._told]
            read[block], feed[block] = self._outputs(answer)
        step, drive = self._stepped(answers, recording.time, solved)
        direct = answers[:, : len(self.states), acting].copy()
        return Along(
            recording.time, step, drive, read, feed, direct, answering, {**fixed, **values, "time": recording.time}
        )

    def _stepped(self, answers: np.ndarray, time: np.ndarray, values: Evaluator) -> tuple[np.ndarray, np.ndarray]:
        """(step, drive) from sample to sample, with what a sampled controller remembers where that can be followed;
        else it is held as the trajectory has it."""
        x, whole = len(self.states), len(self.states) + len(self.memory)
        rates = answers[:, :x]
        if self.memory:
            rates = np.concatenate([rates, np.zeros((len(time), whole - x, answers.shape[2]))], axis=1)
            with suppress(NotNumeric):
                return through_ticks(rates, time, self._sampling(answers, time, values), x)
        return flows(rates, np.arange(len(time) - 1), np.diff(time))

    def _sampling(self, answers: np.ndarray, time: np.ndarray, values: Evaluator) -> Sampling:
        unit = np.eye(answers.shape[2])
        kept = [*self.states, *self.memory, *(self._kept(n) for n in self.inputs)]
        known = {name: np.broadcast_to(unit[k], (len(time), len(unit))) for k, name in enumerate(kept)}
        known |= {_named(self.unknowns[n]): answers[:, k] for k, n in enumerate(self._told)}
        return Sampling(self.prepared, self.memory, values, known, time)

    @cached_property
    def _told(self) -> list[int]:
        """Unknowns whose answers are kept: the rates, and what sampled controllers read."""
        read = read_at_ticks(self.prepared) if self.memory else set()
        return [k for k, u in enumerate(self.unknowns) if k < len(self.states) or _named(u) in read]

    @cached_property
    def _reached(self) -> np.ndarray:
        """(u, inputs): which unknowns an input can change at once at all, by what stands in which row: with a row
        assigned to each unknown, it follows the others that stand there. Elsewhere an answer is rounding."""
        stands = np.zeros((len(self.unknowns), len(self.unknowns)), bool)
        enters = np.zeros((len(self.unknowns), len(self.inputs)), bool)
        for r, (unknowns, columns) in enumerate(zip(self._by_unknown, self._by_column, strict=True)):
            stands[r, list(unknowns)] = True
            enters[r, [c for c in columns if c < len(self.inputs)]] = True
        row_of = maximum_bipartite_matching(csr_matrix(stands), perm_type="row")  # of each unknown
        if np.any(row_of < 0):
            raise NotNumeric("its equations cannot be assigned to its unknowns")
        reached, follows = enters[row_of], csr_matrix(stands[row_of], dtype=np.int32)
        while np.any(further := (follows @ reached.astype(np.int32) > 0) & ~reached):
            reached |= further
        return reached

    def _kept(self, name: str) -> str:
        return self.prepared.aliases.get(name, (name, 1))[0]

    def _blocks(self, samples: int) -> Iterator[slice]:
        """Samples in blocks, of which arrays of unknowns by all that they answer to take little."""
        answered = len(self.unknowns) + len(self.states) + len(self.inputs) + len(self.parameters)
        return blocks(samples, len(self.unknowns) * answered)

    def of(self, name: str, along: Along) -> np.ndarray:
        """(n,) of a variable, by any of its names, along a run."""
        kept, sign = self.prepared.aliases.get(name, (name, 1))
        return sign * along.values[kept]

    def _trajectory(
        self, point: Mapping[str, float], recording: Recording, efforts: Mapping[str, RecordedInput] | None
    ) -> tuple[dict[str, np.ndarray], dict[str, float]]:
        """(values of what varies, values of parameters); unknowns that the model does not show are zero as yet."""
        storage, known = self.prepared.storage, self.machine.model.variables
        names = [*storage.states, *storage.algebraics, *storage.inputs, *storage.discretes]
        values = self.machine.trajectory(point, recording, [n for n in names if n in known], efforts)
        values |= {n: np.zeros(len(recording.time)) for n in names if n not in known}
        return values, self.machine.constants(point, recording)

    def _solved(self, values: dict[str, np.ndarray], fixed: Mapping[str, float], time: np.ndarray) -> Evaluator:
        """An evaluator at the trajectory, with what the run does not give solved for: der(x) are added to `values`."""
        names = list(map(_named, self.unknowns))
        for name in names[: len(self.states)]:
            values[name] = np.zeros(len(time))
        for _ in range(NEWTON):
            evaluator = Evaluator(self._leaf(values, fixed, time))
            course, change = finite(evaluator, len(time)), np.empty((len(time), len(names)))
            for block in self._blocks(len(time)):
                matrix = table(self._by_unknown, len(names), course, block)
                miss = np.stack([np.broadcast_to(evaluator(r), time.shape)[block] for r in self.residuals], axis=1)
                change[block] = -np.linalg.solve(matrix, miss[:, :, None])[:, :, 0]
            for k, name in enumerate(names):
                values[name] = values[name] + change[:, k]
            size = np.array([np.abs(values[name]).max(initial=0.0) for name in names])
            if np.all(np.abs(change).max(axis=0, initial=0.0) <= 1e-9 * size + 1e-300):
                break
        return Evaluator(self._leaf(values, fixed, time))

    def _leaf(
        self, values: Mapping[str, np.ndarray], fixed: Mapping[str, float], time: np.ndarray
    ) -> Callable[[Expr], Value]:  # fmt: skip
        relations = self.prepared.relations

        def leaf(n: Expr) -> Value:
            if n.op == "time":
                return time
            if n.op == "der":
                return values[f"der({n.args[0].value})"]
            if n.op == "rel":
                relation = relations[n.value]
                inner = Evaluator(leaf)
                return np.greater(inner(relation.left), inner(relation.right))
            if n.op in ("tick", "initial", "terminal"):
                return False
            name = str(n.args[0].value if n.op == "pre" else n.value)
            if name in values:
                return values[name]
            if name in fixed:
                return float(fixed[name])
            bound = self.prepared.model.variables.get(name)
            if bound is not None and bound.binding is not None:  # what the generator computes once from parameters
                return Evaluator(leaf)(bound.binding)
            raise NotNumeric(f"{name} is not known along the trajectory")

        return leaf

    def _outputs(self, answer: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        states, names = len(self.states) + len(self.memory), list(self.machine.columns.values())
        both = np.zeros((len(answer), len(names), answer.shape[2]))
        place = {str(u.value): k for k, u in enumerate(self.unknowns) if u.op == "var"}
        for i, name in enumerate(names):
            kept, sign = self.prepared.aliases.get(name, (name, 1))
            if kept in self.states:
                both[:, i, self.states.index(kept)] = sign
            elif kept in self.memory:
                both[:, i, len(self.states) + self.memory.index(kept)] = sign
            elif kept in place:
                both[:, i] = sign * answer[:, place[kept]]
            elif kept not in self.prepared.storage.inputs:
                raise NotNumeric(f"{name} is no state and no algebraic variable")
        return both[:, :, :states], both[:, :, states:]


def _named(unknown: Expr) -> str:
    return f"der({unknown.args[0].value})" if unknown.op == "der" else str(unknown.value)


def _without_rounding(answer: np.ndarray, matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Answers (n, u, b) with zero where terms cancel but for their rounding, in any units: an effort that does nothing
    there, as what is pushed into an ideal source."""
    terms = np.abs(np.linalg.inv(matrix)) @ np.abs(right)
    return np.where(np.abs(answer) > ROUNDING * terms, answer, 0.0)


def _partials(residual: Expr, leaves: list[Expr]) -> dict[int, Expr]:
    found = {k: partial(residual, leaf) for k, leaf in enumerate(leaves)}
    return {k: d for k, d in found.items() if d is not ZERO and not (d.op == "const" and d.value == 0)}
