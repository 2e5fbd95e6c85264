"""What an expression depends on: its leaves, memoised on the hash-consed nodes."""

from __future__ import annotations

from collections.abc import Callable, Collection

from lacuna.codegen.symbolic.expr import Expr, table, transform, walk

LEAF_OPS = frozenset(("var", "der", "pre", "time", "rel", "tick", "initial", "terminal"))


def leaves(e: Expr) -> frozenset[Expr]:
    """Variables, derivatives, pre-values, time, frozen relations and ticks that occur in `e`.

    `der(x)` and `pre(d)` are leaves of their own: `x` and `d` do not occur in them.
    """
    memo = table().leaves
    found = memo.get(e)
    if found is None:
        if e.op in LEAF_OPS:
            found = frozenset((e,))
        else:
            below = [leaves(a) for a in (e.args[:1] if e.op == "annotated" else e.args)]
            found = below[0] if len(below) == 1 else frozenset().union(*below)
        memo[e] = found
    return found


def names_in(e: Expr) -> frozenset[str]:
    """Names of the variables in `e`, those under a derivative or before an event included."""
    memo = table().names
    found = memo.get(e)
    if found is None:
        found = memo[e] = frozenset(str(n.value) for n in walk(e) if n.op == "var")
    return found


def holds(e: Expr, test: Callable[[Expr], bool]) -> bool:
    """Whether some part of `e` passes a test (a function that lasts: tables of thousands of values stand in hundreds of
    calls, and are looked at once)."""
    memo = table().holding.setdefault(test, {})
    found = memo.get(e)
    if found is None:
        found = memo[e] = test(e) or any(holds(a, test) for a in e.args)
    return found


def with_leaves(e: Expr, values: dict[Expr, Expr]) -> Expr:
    """`e` with leaves replaced by values. A leaf is whole: what stands for `x` does not stand inside `der(x)`."""
    return transform(e, lambda n: values.get(n, n) if n.op in LEAF_OPS else None, {})


def depends(e: Expr, leaf: Expr) -> bool:
    return leaf in leaves(e)


def parts(e: Expr, operators: tuple[str, ...]) -> list[Expr]:
    """What `e` is made of by these operators, each once, from left to right. What stands in many places is one node and
    is looked at once: doubled n times, it stands in 2^n."""
    found: list[Expr] = []
    seen: set[Expr] = set()
    stack = [e]
    while stack:
        n = stack.pop()
        if n not in seen:
            seen.add(n)
            if n.op in operators:
                stack.extend(reversed(n.args))
            else:
                found.append(n)
    return found


def always_reads(e: Expr, wanted: Collection[Expr]) -> bool:
    """Does the value of `e` take one of these, whatever conditions hold?"""
    waiting = [e]
    while waiting:
        n = waiting.pop()
        if n in wanted:
            return True
        waiting += n.args[:1] if n.op == "if" else n.args
    return False
