"""Terms of arrays: constructors, products, slices, reductions, reshapes; NumPy says what they are worth."""

from __future__ import annotations

from collections.abc import Callable
import operator

import numpy as np

from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.terms import Growth, Kind, Scope, Term, apply

SIZES = (1, 2, 3, 4)


def grow_array(growth: Growth, kind: Kind, depth: int) -> Term:
    dice = growth.dice
    if kind.base != "R" or depth > 2 or dice.random() < 0.15 * depth:
        return _leaf(growth, kind, depth)
    makers = [_elementwise, _elementwise, _product, _chosen, _comprehension, _shaped]
    return dice.choice(makers)(growth, kind, depth)


def _leaf(growth: Growth, kind: Kind, depth: int) -> Term:
    found = [n for n, k in growth.names.items() if k == kind]
    if found and growth.dice.random() < 0.6:
        name = growth.dice.choice(found)
        return Term(name, lambda scope: scope[name])
    return _constructor(growth, kind, max(depth, 2))


def _constructor(growth: Growth, kind: Kind, depth: int) -> Term:
    inner = Kind(kind.base, kind.shape[1:])
    parts = [growth.grow(inner, depth + 1) for _ in range(kind.shape[0])]
    if kind.base == "R" and len(kind.shape) == 2 and growth.dice.random() < 0.5:
        rows = [[growth.grow(Kind("R"), depth + 2) for _ in range(kind.shape[1])] for _ in range(kind.shape[0])]
        text = "[" + "; ".join(", ".join(t.text for t in row) for row in rows) + "]"
        return Term(text, lambda s: np.array([[float(t.worth(s)) for t in row] for row in rows]))
    kinds = {"R": float, "I": int, "B": bool, "E": int}
    text = "{" + ", ".join(p.text for p in parts) + "}"
    return Term(text, lambda s: np.array([p.worth(s) for p in parts], dtype=kinds[kind.base]))


def _elementwise(growth: Growth, kind: Kind, depth: int) -> Term:
    a = growth.grow(kind, depth + 1)
    same, scalar = (lambda: growth.grow(kind, depth + 1)), (lambda: growth.grow(Kind("R"), depth + 1))
    choices: list[tuple[str, Callable, list[Callable[[], Term]]]] = [
        ("({} + {})", operator.add, [same]), ("({} - {})", operator.sub, [same]), ("({} .* {})", operator.mul, [same]),
        ("({}*{})", operator.mul, [scalar]), ("({}/{})", m.divide, [scalar]), ("({} ./ {})", m.divide, [same]),
        ("({} .+ {})", operator.add, [scalar]), ("({} .- {})", operator.sub, [scalar]), ("(-{})", operator.neg, []),
        ("sin({})", np.sin, []), ("abs({})", np.abs, []), ("({} .^ 2)", np.square, []), ("tanh({})", np.tanh, []),
    ]  # fmt: skip
    text, meaning, more = growth.dice.choice(choices)
    return apply(text, meaning, [a, *(f() for f in more)], "R")


def _product(growth: Growth, kind: Kind, depth: int) -> Term:
    k, shape = growth.dice.choice(SIZES), kind.shape
    if len(shape) == 2:
        left, right = (shape[0], k), (k, shape[1])
    else:
        left, right = growth.dice.choice((((shape[0], k), (k,)), ((k,), (k, shape[0]))))
    parts = [growth.grow(Kind("R", s), depth + 1) for s in (left, right)]
    return apply("({}*{})", operator.matmul, parts, "R")


def _chosen(growth: Growth, kind: Kind, depth: int) -> Term:
    parts = [growth.grow(Kind("B"), depth + 1), *(growth.grow(kind, depth + 1) for _ in range(2))]
    return apply("(if {} then {} else {})", lambda c, a, b: a if c else b, parts, "R")


def _comprehension(growth: Growth, kind: Kind, depth: int) -> Term:
    """{e for i in range}, rows of an outer one for a matrix."""
    n = kind.shape[0]
    index, values, text = _range(growth, n)
    inner = _with_index(growth, index).grow(Kind(kind.base, kind.shape[1:]), depth + 1)

    def worth(scope: Scope) -> m.Value:
        return np.array([inner.worth({**scope, index: v}) for v in values], dtype=float)

    return Term(f"{{{inner.text} for {index} in {text}}}", worth)


def _range(growth: Growth, n: int) -> tuple[str, list[int], str]:
    """A loop's name that is new here, its values and its text."""
    index = f"m{sum(name[0] == 'm' and name[1:].isdigit() for name in growth.names) + 1}"
    start, step = growth.dice.choice((1, 0, -2, 3)), growth.dice.choice((1, 1, 2, -1, -3))
    values = [start + step * k for k in range(n)]
    over = n > 1 and growth.dice.random() < 0.3
    text = (
        "{" + ", ".join(map(str, values)) + "}" if over else f"{start}:{f'({step}):' if step != 1 else ''}{values[-1]}"
    )
    return index, values, text.replace("({", "{")


def _with_index(growth: Growth, index: str) -> Growth:
    return Growth(growth.dice, {**growth.names, index: Kind("I")})


def _shaped(growth: Growth, kind: Kind, depth: int) -> Term:
    return _matrix_shaped(growth, kind, depth) if len(kind.shape) == 2 else _vector_shaped(growth, kind, depth)


def _matrix_shaped(growth: Growth, kind: Kind, depth: int) -> Term:
    (rows, columns), dice = kind.shape, growth.dice
    of = lambda *shape: growth.grow(Kind("R", shape), depth + 1)  # noqa: E731
    pick = dice.randrange(6)
    if pick == 0 and rows == columns:
        return apply("diagonal({})", np.diag, [of(rows)], "R")
    if pick == 1 and rows == columns:
        return apply("symmetric({})", lambda a: np.triu(a) + np.triu(a, 1).T, [of(rows, rows)], "R")
    if pick == 2 and rows > 1:
        parts = [of(1, columns), of(rows - 1, columns)]
        return apply("cat(1, {}, {})", lambda a, b: np.concatenate([a, b]), parts, "R")
    if pick == 3 and columns > 1:
        return apply("[{}, {}]", lambda a, b: np.hstack([a, b]), [of(rows, 1), of(rows, columns - 1)], "R")
    if pick == 4:
        return apply("outerProduct({}, {})", np.outer, [of(rows), of(columns)], "R")
    if pick == 5 and kind.shape == (3, 3):
        skew = lambda v: np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]], float)  # noqa: E731
        return apply("skew({})", skew, [of(3)], "R")
    return apply("transpose({})", np.transpose, [of(columns, rows)], "R")


def _vector_shaped(growth: Growth, kind: Kind, depth: int) -> Term:
    (n,), dice = kind.shape, growth.dice
    of = lambda *shape: growth.grow(Kind("R", shape), depth + 1)  # noqa: E731
    pick = dice.randrange(6)
    if pick == 0 and n > 1:
        return apply("cat(1, {}, {})", lambda a, b: np.concatenate([a, b]), [of(1), of(n - 1)], "R")
    if pick == 1 and n == 3:
        return apply("cross({}, {})", np.cross, [of(3), of(3)], "R")
    if pick == 2 and n > 1:
        parts = [growth.grow(Kind("R"), depth + 1) for _ in range(2)]
        return apply(f"linspace({{}}, {{}}, {n})", lambda a, b: np.linspace(a, b, n), parts, "R")
    if pick == 3:
        return apply(f"fill({{}}, {n})", lambda a: np.full(n, a, float), [growth.grow(Kind("R"), depth + 1)], "R")
    if pick == 4:
        return apply("vector({})", np.ravel, [of(n, 1)], "R")
    return _slice(growth, n)


def _slice(growth: Growth, n: int) -> Term:
    """Of a name in scope: a range, a list, a row or a column."""
    dice, choices = growth.dice, []
    for name, k in growth.names.items():
        if k.base != "R" or not k.shape:
            continue
        if len(k.shape) == 1 and k.shape[0] >= n:
            first = dice.randrange(k.shape[0] - n + 1)
            choices.append((f"{name}[{first + 1}:{first + n}]", name, (slice(first, first + n),)))
            chosen = [dice.randrange(k.shape[0]) for _ in range(n)]
            choices.append((f"{name}[{{{', '.join(str(c + 1) for c in chosen)}}}]", name, (chosen,)))
        if len(k.shape) == 2 and k.shape[1] == n:
            row = dice.randrange(k.shape[0])
            choices += [(f"{name}[{row + 1}, :]", name, (row,)), (f"{name}[end, :]", name, (-1,))]
        if len(k.shape) == 2 and k.shape[0] == n:
            column = dice.randrange(k.shape[1])
            choices.append((f"{name}[:, {column + 1}]", name, (slice(None), column)))
    if not choices:
        return _constructor(growth, Kind("R", (n,)), 2)
    text, name, at = dice.choice(choices)
    return Term(text, lambda scope: scope[name][at])


def grow_reduction(growth: Growth, kind: Kind, depth: int) -> Term:
    """A scalar from an array: sum, product, min, max, a scalar product, an element, a sum over an index."""
    dice = growth.dice
    if dice.random() < 0.4:
        return _element(growth, kind, depth)
    name, meaning = dice.choice((("sum", sum), ("product", np.prod), ("min", min), ("max", max)))
    if dice.random() < 0.5:
        index, values, text = _range(growth, dice.choice(SIZES))
        inner = _with_index(growth, index).grow(kind, depth + 1)
        python = {"sum": int, "I": int}.get(kind.base, float)
        return Term(
            f"{name}({inner.text} for {index} in {text})",
            lambda s: m.checked(python(meaning([inner.worth({**s, index: v}) for v in values]))),
        )
    if kind.base == "R" and dice.random() < 0.3:
        n = dice.choice(SIZES)
        return apply("({}*{})", np.dot, [growth.grow(Kind("R", (n,)), depth + 1) for _ in range(2)], "R")
    shape = dice.choice([(n,) for n in SIZES] + [(2, 3)])
    part = growth.grow(Kind(kind.base, shape), depth + 1)
    whole = {"R": float, "I": int}[kind.base]
    return apply(f"{name}({{}})", lambda a: whole(meaning(list(a.ravel()))), [part], kind.base)


def _element(growth: Growth, kind: Kind, depth: int) -> Term:
    """Of a name in scope, by subscripts that may vary: mod(e, n) + 1 never leaves the array."""
    found = [(n, k.shape) for n, k in growth.names.items() if k.base == kind.base and k.shape]
    if not found:
        return growth.leaf(kind)
    name, shape = growth.dice.choice(found)
    subscripts = [growth.grow(Kind("I"), depth + 1) for _ in shape]
    text = ", ".join(f"mod({t.text}, {n}) + 1" for t, n in zip(subscripts, shape, strict=True))

    def worth(scope: Scope) -> m.Value:
        at = tuple(t.worth(scope) % n for t, n in zip(subscripts, shape, strict=True))
        return scope[name][at].item()

    return Term(f"{name}[{text}]", worth)
