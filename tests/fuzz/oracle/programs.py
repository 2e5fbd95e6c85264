"""Random bodies of functions, and an interpreter of them: loops, branches, break, return, elements of arrays."""

from __future__ import annotations

from collections.abc import Callable, MutableMapping
from contextlib import suppress
from dataclasses import dataclass
import random

import numpy as np

from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.terms import Growth, Kind, Scope, Term

Memory = MutableMapping[str, m.Value]
ROUNDS = 400  # of all loops of one call, before the draw is left

LOCALS = {
    "r1": Kind("R"),
    "r2": Kind("R"),
    "k1": Kind("I"),
    "c1": Kind("B"),
    "a1": Kind("R", (3,)),
    "a2": Kind("R", (2, 3)),
}
_TYPES = {"R": "Real", "I": "Integer", "B": "Boolean", "E": "E"}


class _Break(Exception):
    pass


class _Return(Exception):
    pass


@dataclass(frozen=True)
class Statement:
    lines: list[str]
    run: Callable[[Memory], None]


@dataclass(frozen=True)
class Function:
    """`text` declares it; `worth` takes the values of its inputs by name and gives its output."""

    text: str
    worth: Callable[[Scope], m.Value]


def declared(name: str, kind: Kind, prefix: str = "", value: str = "", free: bool = False) -> str:
    """A declaration; with `free` the sizes of an array follow from the argument."""
    sizes = ", ".join(":" if free else str(n) for n in kind.shape)
    return f"{prefix}{_TYPES[kind.base]} {name}{f'[{sizes}]' if sizes else ''}{f' = {value}' if value else ''};"


class _Body:
    def __init__(self, dice: random.Random, names: dict[str, Kind], result: Kind) -> None:
        self.dice, self.names, self.result = dice, names, result
        self.assignable = {**LOCALS, "y": result}

    def block(self, depth: int, loop: bool, names: dict[str, Kind]) -> Statement:
        parts = [self.statement(depth, loop, names) for _ in range(self.dice.randrange(1, 4))]

        def run(memory: Memory) -> None:
            for part in parts:
                part.run(memory)

        return Statement([f"  {line}" for part in parts for line in part.lines], run)

    def statement(self, depth: int, loop: bool, names: dict[str, Kind]) -> Statement:
        pick = self.dice.random()
        if depth > 2 or pick < 0.5:
            return self._assignment(names)
        if loop and pick < 0.6:
            return self._leaving(names, "break", _Break)
        if pick < 0.63:
            return self._leaving(names, "return", _Return)
        if pick < 0.78:
            return self._branch(depth, loop, names)
        return self._for(depth, names) if pick < 0.9 else self._while(depth, names)

    def _grow(self, kind: Kind, names: dict[str, Kind], depth: int = 2) -> Term:
        return Growth(self.dice, names).grow(kind, depth)

    def _assignment(self, names: dict[str, Kind]) -> Statement:
        name = self.dice.choice([*self.assignable, "y"])
        kind = self.assignable[name]
        if kind.shape and self.dice.random() < 0.7:
            return self._element(name, kind, names)
        term = self._grow(kind, names)

        def run(memory: Memory) -> None:
            value = m.as_kind(term.worth(memory), kind.base)
            memory[name] = value.copy() if isinstance(value, np.ndarray) else value

        return Statement([f"{name} := {term.text};"], run)

    def _element(self, name: str, kind: Kind, names: dict[str, Kind]) -> Statement:
        subscripts = [self._grow(Kind("I"), names, 3) for _ in kind.shape]
        term = self._grow(Kind(kind.base), names)
        text = ", ".join(f"mod({t.text}, {n}) + 1" for t, n in zip(subscripts, kind.shape, strict=True))

        def run(memory: Memory) -> None:
            at = tuple(t.worth(memory) % n for t, n in zip(subscripts, kind.shape, strict=True))
            changed = memory[name].copy()
            changed[at] = term.worth(memory)
            memory[name] = changed

        return Statement([f"{name}[{text}] := {term.text};"], run)

    def _leaving(self, names: dict[str, Kind], word: str, leave: type[Exception]) -> Statement:
        condition = self._grow(Kind("B"), names)

        def run(memory: Memory) -> None:
            if condition.worth(memory):
                raise leave

        return Statement([f"if {condition.text} then", f"  {word};", "end if;"], run)

    def _branch(self, depth: int, loop: bool, names: dict[str, Kind]) -> Statement:
        conditions = [self._grow(Kind("B"), names) for _ in range(self.dice.choice((1, 1, 2)))]
        blocks = [self.block(depth + 1, loop, names) for _ in range(len(conditions) + self.dice.randrange(2))]
        heads = [f"{'else' * bool(k)}if {c.text} then" for k, c in enumerate(conditions)] + ["else"]
        lines = [line for head, block in zip(heads, blocks, strict=False) for line in (head, *block.lines)]

        def run(memory: Memory) -> None:
            for condition, block in zip(conditions, blocks, strict=False):
                if condition.worth(memory):
                    block.run(memory)
                    return
            if len(blocks) > len(conditions):
                blocks[-1].run(memory)

        return Statement([*lines, "end if;"], run)

    def _for(self, depth: int, names: dict[str, Kind]) -> Statement:
        index, dice = f"j{depth}", self.dice
        start, step, count = dice.choice((1, 0, -1, 4)), dice.choice((1, 1, 2, -1)), dice.choice((0, 1, 2, 3, 5))
        values = [start + step * k for k in range(count)]
        last = start + step * (count - 1) if count else start - step
        text = f"{start}:{f'{step}:' if step != 1 else ''}{last}".replace(":-1:", ":(-1):")
        if "n" in names and count and dice.random() < 0.3:  # as often as an argument says
            values, text = None, "1:mod(n, 5)"
        elif count and dice.random() < 0.3:
            text = "{" + ", ".join(map(str, values)) + "}"
        block = self.block(depth + 1, True, {**names, index: Kind("I")})

        def run(memory: Memory) -> None:
            for value in range(1, memory["n"] % 5 + 1) if values is None else values:
                memory[index] = value
                _count(memory)
                try:
                    block.run(memory)
                except _Break:
                    break

        return Statement([f"for {index} in {text} loop", *block.lines, "end for;"], run)

    def _while(self, depth: int, names: dict[str, Kind]) -> Statement:
        counter, condition = f"w{depth}", self._grow(Kind("B"), names)
        most = self.dice.choice((1, 3, 6))
        block = self.block(depth + 1, True, names)

        def run(memory: Memory) -> None:
            memory[counter] = 0
            while memory[counter] < most and condition.worth(memory):
                memory[counter] += 1
                _count(memory)
                try:
                    block.run(memory)
                except _Break:
                    break

        head = f"while {counter} < {most} and {condition.text} loop"
        return Statement([f"{counter} := 0;", head, f"  {counter} := {counter} + 1;", *block.lines, "end while;"], run)


def _count(memory: Memory) -> None:
    memory["rounds"] += 1
    if memory["rounds"] > ROUNDS:
        raise m.Unfit


def draw_function(dice: random.Random, name: str, inputs: dict[str, Kind], result: Kind) -> Function:
    """A function of `inputs` with local variables, each with a value to begin with."""
    body = _Body(dice, {**inputs, **LOCALS}, result)
    starts, known = {}, dict(inputs)
    for local, kind in LOCALS.items():  # defaults of what is protected may use what stands before
        starts[local] = Growth(dice, known).grow(kind, 2)
        known[local] = kind
    first = Growth(dice, known).grow(result, 2)
    body.names["y"] = result
    block = body.block(0, False, body.names)
    lines = [f"function {name}"]
    lines += [f"  {declared(n, k, 'input ', free=dice.random() < 0.5)}" for n, k in inputs.items()]
    lines += [f"  {declared('y', result, 'output ')}", "protected"]
    lines += [f"  {declared(n, k, value=starts[n].text)}" for n, k in LOCALS.items()]
    lines += [f"  Integer w{depth};" for depth in range(4)]
    lines += ["algorithm", f"  y := {first.text};", *block.lines, f"end {name};"]

    def worth(arguments: Scope) -> m.Value:
        memory: Memory = {**arguments, "rounds": 0}
        for local, term in starts.items():
            memory[local] = m.as_kind(term.worth(memory), LOCALS[local].base)
        memory["y"] = m.as_kind(first.worth(memory), result.base)
        with suppress(_Return):
            block.run(memory)
        return m.checked(memory["y"])

    return Function("\n".join(f"  {line}" for line in lines), worth)
