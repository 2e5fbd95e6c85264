"""Random models from the grammar of the language: mostly well formed, often wrong in meaning."""

from __future__ import annotations

import random

_NAMES = ("x", "y", "z", "w", "phi", "n", "k", "p", "b", "v", "part", "pin", "f", "time", "i")
_TYPES = ("Real", "Real", "Real", "Integer", "Boolean", "Part", "Pin", "Data", "Mode", "Sub.Inner", "String")
_UNITS = ("V", "A", "N.m", "rad/s", "kg.m2", "s", "1", "%", "mm", "m/(s2)", "x/y")
_FUNCTIONS = (
    "sin", "sqrt", "abs", "exp", "log", "der", "pre", "f", "g", "sum", "max", "min", "size", "mod", "div", "noEvent",
    "edge", "change", "floor", "integer", "sign", "atan2", "fill", "zeros", "linspace", "transpose", "Data", "cat",
)  # fmt: skip

_PRELUDE = """\
type Mode = enumeration(low, high);
connector Pin
  Real v(unit = "V");
  flow Real i(unit = "A");
end Pin;
record Data
  parameter Real a = 1;
  Real c[2] = {1, 2};
end Data;
function f
  input Real a;
  input Real s = 2;
  output Real b;
  output Integer c;
algorithm
  b := if a > s then a else s;
  c := 1;
end f;
function g
  input Real v[:];
  output Real s;
algorithm
  s := 0;
  while s < sum(v) loop
    s := s + 1;
    if s > 100 then
      break;
    end if;
  end while;
end g;
package Sub
  constant Real c = 3;
  model Inner
    Real q(start = 1);
  equation
    der(q) = -q;
  end Inner;
end Sub;
partial model Two
  Pin pin;
  Pin other;
end Two;
model Part
  extends Two;
  parameter Real R(min = 0) = 2;
  parameter Integer n = 2;
  Real x[n];
equation
  pin.v - other.v = R*pin.i;
  pin.i + other.i = 0;
  x = fill(pin.v, n);
end Part;
"""


class _Growth:
    def __init__(self, dice: random.Random) -> None:
        self.dice = dice

    def name(self) -> str:
        dice = self.dice
        text = dice.choice(_NAMES)
        if dice.random() < 0.2:
            text += f"[{self.expression(3)}]"
        if dice.random() < 0.2:
            text += "." + dice.choice((*_NAMES, "R", "low", "a", "c"))
        return text

    def expression(self, depth: int = 0) -> str:
        """Deeper is simpler, so that growth ends."""
        dice, go = self.dice, lambda: self.expression(depth + 1)
        if depth > 3 or dice.random() < 0.25:
            return dice.choice((self.literal(), dice.choice(_NAMES), self.name() if depth < 3 else "time"))
        kind = dice.randrange(9)
        if kind < 3:
            return f"({go()} {dice.choice(('+', '-', '*', '/', '^', '.*', '.^', './'))} {go()})"
        if kind == 3:
            return f"({go()} {dice.choice(('<', '>', '<=', '>=', '==', '<>', 'and', 'or'))} {go()})"
        if kind == 4:
            return f"(if {go()} > {go()} then {go()} else {go()})"
        if kind == 5:
            return f"{dice.choice(_FUNCTIONS)}({', '.join(go() for _ in range(dice.choice((1, 1, 2, 3))))})"
        if kind == 6:
            return "{" + ", ".join(go() for _ in range(dice.randrange(1, 4))) + "}"
        if kind == 7:
            return f"{{{go()} for i in {dice.choice(('1:3', '{1, 2}', 'Mode', go()))}}}"
        return dice.choice((f"(-{go()})", f"(not {go()})", f"[{go()}, {go()}; {go()}, {go()}]", f"({go()}:{go()})"))

    def literal(self) -> str:
        return self.dice.choice(("0", "1", "2", "3.5", "1e-3", "true", "false", '"text"', "Mode.low", "Sub.c"))

    def declaration(self) -> str:
        dice = self.dice
        prefix = dice.choice(("", "", "", "parameter ", "constant ", "discrete ", "input ", "final parameter "))
        size = dice.choice(("", "", "", "[2]", "[n]", "[:]", "[2, 3]", f"[{self.expression(2)}]"))
        change = ""
        if dice.random() < 0.4:
            key = dice.choice(("start", "fixed", "unit", "min", "R", "x", "each start", "final max", "pin(v(start"))
            value = f'"{dice.choice(_UNITS)}"' if key == "unit" else self.expression(2)
            change = f"({key} = {value}" + ")" * (1 + key.count("("))
        binding = f" = {self.expression(1)}" if dice.random() < 0.4 else ""
        condition = f" if {self.expression(2)}" if dice.random() < 0.08 else ""
        return f"  {prefix}{dice.choice(_TYPES)} {dice.choice(_NAMES)}{size}{change}{binding}{condition};"

    def equation(self, depth: int = 0) -> str:
        dice, pad = self.dice, "  " * (depth + 1)
        kind = dice.randrange(10 if depth < 2 else 6)
        if kind < 5:
            return f"{pad}{self.name()} = {self.expression()};"
        if kind == 5:
            return f"{pad}connect({self.name()}, {self.name()});"
        inner = "\n".join(self.equation(depth + 1) for _ in range(dice.randrange(1, 3)))
        if kind == 6:
            other = "\n".join(self.equation(depth + 1) for _ in range(dice.randrange(1, 3)))
            return f"{pad}if {self.expression(1)} then\n{inner}\n{pad}else\n{other}\n{pad}end if;"
        if kind == 7:
            return f"{pad}for i in {dice.choice(('1:2', '1:n', self.expression(2)))} loop\n{inner}\n{pad}end for;"
        if kind == 8:
            return f"{pad}when {self.expression(1)} then\n{inner}\n{pad}end when;"
        return f'{pad}assert({self.expression(1)}, "text");'

    def statement(self, depth: int = 0) -> str:
        dice, pad = self.dice, "  " * (depth + 1)
        kind = dice.randrange(9 if depth < 2 else 5)
        if kind < 5:
            return f"{pad}{self.name()} := {self.expression()};"
        inner = "\n".join(self.statement(depth + 1) for _ in range(dice.randrange(1, 3)))
        head, tail = dice.choice(
            (("if {} then", "if"), ("for i in 1:3 loop", "for"), ("when {} then", "when"), ("while {} loop", "while"))
        )
        return f"{pad}{head.format(self.expression(1))}\n{inner}\n{pad}end {tail};"


def random_model(dice: random.Random) -> str:
    """The text of a file whose last class is a model to flatten."""
    grow = _Growth(dice)
    lines = [_PRELUDE, "model Fuzz"]
    if dice.random() < 0.3:
        lines.append(f"  extends Part(R = {grow.expression(2)});")
    lines += [grow.declaration() for _ in range(dice.randrange(1, 8))]
    lines.append("equation")
    lines += [grow.equation() for _ in range(dice.randrange(1, 6))]
    if dice.random() < 0.3:
        lines += ["algorithm", *(grow.statement() for _ in range(dice.randrange(1, 4)))]
    if dice.random() < 0.2:
        lines += ["initial equation", grow.equation()]
    lines.append("end Fuzz;")
    return "\n".join(lines) + "\n"
