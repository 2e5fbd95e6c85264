"""Models grown to be run: well posed more often than not, with states, relations, functions, discretes, resets.

Three solvers that share nothing but the model (multistep implicit, explicit and linearly implicit one-step) must agree,
or say that they could not: python -m tests.fuzz --seconds 600.
"""

from __future__ import annotations

import random

FUNCTIONS = """  function bump
    input Real a;
    output Real b;
  algorithm
    b := a;
    for k in 1:3 loop
      b := b/(1 + b^2);
    end for;
  end bump;
  function worst
    input Real v[:];
    output Real m;
  algorithm
    m := v[1];
    for k in 2:size(v, 1) loop
      if v[k] > m then
        m := v[k];
      end if;
    end for;
  end worst;
"""


class _Growth:
    def __init__(self, dice: random.Random) -> None:
        self.dice = dice
        self.states = [f"x{k}" for k in range(1, dice.randrange(1, 5) + 1)]
        self.algebraics = [f"y{k}" for k in range(1, dice.randrange(0, 4) + 1)]
        self.discretes = ["n"] if dice.random() < 0.5 else []
        self.inputs = ["w"] if dice.random() < 0.3 else []

    def number(self) -> str:
        return self.dice.choice(("0.5", "1", "2", "(-1)", "0.1", "3", "(-0.7)", "10", "1e-3"))

    def leaf(self, names: list[str]) -> str:
        return self.dice.choice((*names, *names, "time", self.number(), "k"))

    def expression(self, names: list[str], depth: int = 0) -> str:
        dice = self.dice
        if depth > 2 or dice.random() < 0.3:
            return self.leaf(names)
        go = lambda: self.expression(names, depth + 1)  # noqa: E731
        kind = dice.randrange(12)
        if kind < 5:
            return f"({go()} {dice.choice('+-*+-')} {go()})"
        if kind == 5:
            return f"({go()}/(1 + ({go()})^2))"
        if kind == 6:
            return f"(if {go()} > {go()} then {go()} else {go()})"
        if kind == 7:
            return f"{dice.choice(('sin', 'cos', 'tanh', 'abs', 'atan', 'bump', 'sign'))}({go()})"
        if kind == 8:
            return f"{dice.choice(('min', 'max'))}({go()}, {go()})"
        if kind == 9:
            return f"worst({{{go()}, {go()}, {go()}}})"
        if kind == 10:
            return f"smooth(0, noEvent(if {go()} > 0 then {go()} else 0))"
        return f"{dice.choice(('sqrt(abs', 'log(1 + abs', 'mod(1, 1 + abs'))}({go()}))"

    def clause(self) -> str:
        """A when clause, with a reset now and then."""
        dice, names = self.dice, self.states
        condition = dice.choice(
            (f"{dice.choice(names)} > {self.number()}", f"sample(0.1, {dice.choice(('0.1', '0.25', '0.3'))})",
             f"time > {dice.choice(('0.2', '0.5', '0.77'))}", f"{dice.choice(names)} < pre(n)*0.5")
        )  # fmt: skip
        reset = f" reinit({dice.choice(names)}, {self.leaf(names)});" if dice.random() < 0.4 else ""
        return f"  when {condition} then\n    n = pre(n) + 1;{reset}\n  end when;"


def random_system(seed: int) -> str:
    """The text of a file with a model M: every state damped, every algebraic explicit, from known starts."""
    dice = random.Random(seed)
    grow = _Growth(dice)
    known = [*grow.states, *grow.discretes, *grow.inputs]
    lines = ["model M", FUNCTIONS + f"  parameter Real k = {grow.number()};"]
    lines += [f"  Real {x}(start={grow.number()}, fixed=true);" for x in grow.states]
    lines += [f"  Real {y};" for y in grow.algebraics]
    lines += ["  discrete Real n(start=0, fixed=true);"] if grow.discretes else []
    lines += ["  input Real w(start=0.3);"] if grow.inputs else []
    lines.append("equation")
    for position, y in enumerate(grow.algebraics):
        lines.append(f"  {y} = {grow.expression(known + grow.algebraics[:position])};")
    for x in grow.states:
        lines.append(
            f"  der({x}) = -{dice.choice(('0.1', '1', '5'))}*{x} + {grow.expression(known + grow.algebraics)};"
        )
    lines += [grow.clause()] if grow.discretes else []
    lines.append("end M;")
    return "\n".join(lines) + "\n"
