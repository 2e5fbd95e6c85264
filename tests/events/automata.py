"""Random hybrid automata whose flows have closed forms, played by a program of its own.

Two or three bodies (x_i, v_i) fall, are dragged or swing; relations compare positions, speeds and distances with
thresholds or with each other; chains of when and elsewhen count, ask for counts of other chains, throw bodies back
(reinit) and change the forces. Nothing of it is sought numerically step by step: between events the oracle knows the
flow, and finds the first crossing of each guard on it by brackets.

What an error of a run may do is asked of the oracle too (play.py): it plays again with every state off by that error,
up or down, on each stretch between events. Where that gives another sequence of events, the automaton asks more than
the tolerance gives.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Body:
    """x' = v; `fall`: v' = force, `drag`: v' = (force - v)/T, `swing`: v' = w^2 (force - x). The force is another one
    once chain `chain` has counted to `count`."""

    law: str
    rate: float
    forces: tuple[float, float]
    chain: int
    count: int

    def flow(self, x: float, v: float, force: float, t: np.ndarray | float) -> tuple:
        if self.law == "fall":
            return x + v * t + 0.5 * force * t * t, v + force * t
        if self.law == "drag":
            left = np.exp(-t * self.rate)
            return x + force * t + (v - force) * (1 - left) / self.rate, force + (v - force) * left
        c, s = np.cos(self.rate * t), np.sin(self.rate * t)
        off = x - force
        return force + off * c + v / self.rate * s, v * c - off * self.rate * s

    def text(self, k: int) -> str:
        force = f"(if n{self.chain} >= {self.count} then {self.forces[1]!r} else {self.forces[0]!r})"
        return {
            "fall": force,
            "drag": f"{self.rate!r}*({force} - v{k})",
            "swing": f"{self.rate**2!r}*({force} - x{k})",
        }[self.law]


@dataclass(frozen=True)
class Guard:
    """weights . state > threshold."""

    weights: tuple[float, ...]
    threshold: float

    def value(self, state: Sequence) -> np.ndarray | float:
        return sum(w * s for w, s in zip(self.weights, state, strict=True)) - self.threshold

    def text(self) -> str:
        names = [f"{kind}{k}" for k in range(len(self.weights) // 2) for kind in "xv"]
        terms = [f"{w:+.0f}*{n}" for w, n in zip(self.weights, names, strict=True) if w]
        return f"{' '.join(terms)} > {self.threshold!r}"


@dataclass(frozen=True)
class Branch:
    """`guard` and, where `chain` >= 0, pre(n_chain) >= `count`; then `throws`: (state, factor, addend)."""

    guard: int
    chain: int
    count: int
    throws: tuple[tuple[int, float, float], ...]


@dataclass(frozen=True)
class Automaton:
    number: int
    bodies: tuple[Body, ...]
    start: tuple[float, ...]
    guards: tuple[Guard, ...]
    chains: tuple[tuple[Branch, ...], ...]
    stop: float
    sizes: tuple[float, ...]

    @property
    def text(self) -> str:
        lines = [f"model Automaton{self.number}"]
        for k in range(len(self.bodies)):
            x, v = self.start[2 * k : 2 * k + 2]
            lines.append(f"  Real x{k}(start={x!r}, fixed=true), v{k}(start={v!r}, fixed=true);")
        lines += [f"  Integer n{c}(start=0, fixed=true);" for c in range(len(self.chains))] + ["equation"]
        for k, body in enumerate(self.bodies):
            lines += [f"  der(x{k}) = v{k};", f"  der(v{k}) = {body.text(k)};"]
        for c, branches in enumerate(self.chains):
            for k, b in enumerate(branches):
                more = f" and pre(n{b.chain}) >= {b.count}" if b.chain >= 0 else ""
                lines.append(f"  {'elsewhen' if k else 'when'} {self.guards[b.guard].text()}{more} then")
                lines.append(f"    n{c} = pre(n{c}) + 1;")
                for s, factor, addend in b.throws:
                    name = f"{'xv'[s % 2]}{s // 2}"
                    lines.append(f"    reinit({name}, {factor!r}*{name} + ({addend!r}));")
            lines.append("  end when;")
        return "\n".join([*lines, f"end Automaton{self.number};", ""])


def draw(rng: np.random.Generator, number: int) -> Automaton:
    n, m, size, second = (
        int(rng.integers(2, 4)),
        int(rng.integers(2, 4)),
        10 ** rng.uniform(-6, 6),
        10 ** rng.uniform(-3, 3),
    )
    sizes = (size, size / second) * n

    def of(scale: float) -> float:
        return float(scale * rng.choice([-1, 1]) * rng.uniform(0.1, 1))

    bodies = []
    for _ in range(n):
        law = str(rng.choice(["fall", "drag", "swing"]))
        scale = {"fall": size / second**2, "drag": size / second, "swing": size}[law]
        rate = float(rng.uniform(0.3, 3) / second)
        bodies.append(Body(law, rate, (of(scale), of(scale)), int(rng.integers(m)), int(rng.integers(1, 4))))
    guards = [_guard(rng, sizes, of) for _ in range(int(rng.integers(3, 6)))]
    owned = rng.permutation(2 * n)
    chains = []
    for c in range(m):
        mine = owned[c::m]
        branches = []
        for _ in range(int(rng.integers(1, 4))):
            chain = int(rng.integers(m)) if rng.uniform() < 0.3 else -1
            throws = tuple(_throw(rng, int(s), sizes) for s in mine if rng.uniform() < 0.5)
            branches.append(Branch(int(rng.integers(len(guards))), chain, int(rng.integers(1, 3)), throws))
        chains.append(tuple(branches))
    start = tuple(of(s) for s in sizes)
    return Automaton(number, tuple(bodies), start, tuple(guards), tuple(chains), 5 * second, sizes)


def _guard(rng: np.random.Generator, sizes: Sequence[float], of: Callable[[float], float]) -> Guard:
    kind, k = rng.integers(3), int(rng.integers(len(sizes)))
    weights = [0.0] * len(sizes)
    weights[k] = float(rng.choice([-1, 1]))
    if kind == 0:  # a distance, or a difference of speeds
        weights[(k + 2) % len(sizes)] = -weights[k]
        return Guard(tuple(weights), 0.0)
    return Guard(tuple(weights), of(sizes[k]))


def _throw(rng: np.random.Generator, state: int, sizes: Sequence[float]) -> tuple[int, float, float]:
    if state % 2:  # a speed is turned round, or set
        return (
            (state, -float(rng.uniform(0.3, 1)), 0.0)
            if rng.integers(2)
            else (state, 0.0, sizes[state] * float(rng.uniform(-1, 1)))
        )
    return state, 1.0, sizes[state] * float(rng.uniform(-1, 1))
