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

from lacuna.codegen import flat
from lacuna.codegen.compile import translate
from lacuna.codegen.symbolic.differentiate import Differentiator, partial
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, var
from lacuna.discovery.case.case_model import UNITS
from lacuna.discovery.case.cases import Recording
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.flows import blocks, flows
from lacuna.discovery.efforts.latent.numeric import Evaluator, NotNumeric, Value, finite
from lacuna.discovery.efforts.latent.sampled import Sampling, read_at_ticks, remembered, through_ticks
from lacuna.discovery.efforts.latent.substitution import Answer, Substitution
from lacuna.discovery.fit.machine import Machine
from lacuna.runtime import RecordedInput

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
        answers = np.zeros((n, len(self._told), states + columns))
        read, feed = np.zeros((n, outputs, states)), np.zeros((n, outputs, columns))
        for block in self._blocks(n):
            found = self._answers(course, block)
            for u, answer in enumerate(found):
                acts = answer.columns[(answer.columns >= acting.start) & (answer.columns < acting.stop)]
                answering[u, acts - states] = True
            for k, u in enumerate(self._told):
                answers[block, k, found[u].columns] = found[u].values.T
            read[block], feed[block] = self._outputs(found, block.stop - block.start, states + columns)
        step, drive = self._stepped(answers, recording.time, solved)
        direct = answers[:, : len(self.states), acting].copy()
        return Along(
            recording.time, step, drive, read, feed, direct, answering, {**fixed, **values, "time": recording.time}
        )

    def _answers(self, course: Callable[[Expr], np.ndarray], block: slice) -> list[Answer]:
        """Of each unknown at a block of samples, to states, inputs and parameters."""

        def there(e: Expr) -> np.ndarray:
            return course(e)[block]

        states = len(self.states) + len(self.memory)
        right = [
            {j: there(e) for j, e in by_state.items()} | {states + j: there(e) for j, e in by_column.items()}
            for by_state, by_column in zip(self._by_state, self._by_column, strict=True)
        ]
        return self._substitution.solve(
            there, right, block.stop - block.start, exact=range(states, states + len(self.inputs))
        )

    @cached_property
    def _substitution(self) -> Substitution:
        return Substitution(self._by_unknown)

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
            course, change = finite(evaluator, len(time)), np.zeros((len(names), len(time)))
            miss = [{0: np.broadcast_to(evaluator(r), time.shape)} for r in self.residuals]
            for k, answer in enumerate(self._substitution.solve(course, miss, len(time))):
                change[k] = answer.values.sum(axis=0)
                values[names[k]] = values[names[k]] + change[k]
            size = np.array([np.abs(values[name]).max(initial=0.0) for name in names])
            if np.all(np.abs(change).max(axis=1, initial=0.0) <= 1e-9 * size + 1e-300):
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

    def _outputs(self, found: list[Answer], samples: int, width: int) -> tuple[np.ndarray, np.ndarray]:
        states, names = len(self.states) + len(self.memory), list(self.machine.columns.values())
        both = np.zeros((samples, len(names), width))
        place = {str(u.value): k for k, u in enumerate(self.unknowns) if u.op == "var"}
        for i, name in enumerate(names):
            kept, sign = self.prepared.aliases.get(name, (name, 1))
            if kept in self.states:
                both[:, i, self.states.index(kept)] = sign
            elif kept in self.memory:
                both[:, i, len(self.states) + self.memory.index(kept)] = sign
            elif kept in place:
                both[:, i, found[place[kept]].columns] = sign * found[place[kept]].values.T
            elif kept not in self.prepared.storage.inputs:
                raise NotNumeric(f"{name} is no state and no algebraic variable")
        return both[:, :, :states], both[:, :, states:]


def _named(unknown: Expr) -> str:
    return f"der({unknown.args[0].value})" if unknown.op == "der" else str(unknown.value)


def _partials(residual: Expr, leaves: list[Expr]) -> dict[int, Expr]:
    found = {k: partial(residual, leaf) for k, leaf in enumerate(leaves)}
    return {k: d for k, d in found.items() if d is not ZERO and not (d.op == "const" and d.value == 0)}
