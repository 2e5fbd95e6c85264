"""'Did you mean ...': the known names nearest to one that was not found."""

from __future__ import annotations

from collections.abc import Iterable


def distance(a: str, b: str) -> int:
    """Optimal string alignment distance: insertions, deletions, substitutions, swaps of neighbours."""
    before_previous: list[int] = []
    previous = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        row = [i]
        for j, y in enumerate(b, 1):
            cost = min(previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and a[i - 2] == y:
                cost = min(cost, before_previous[j - 2] + 1)
            row.append(cost)
        before_previous, previous = previous, row
    return previous[-1]


def nearest(name: str, known: Iterable[str], count: int = 3) -> list[str]:
    """Up to `count` names at most about a third of the length away, the nearest first; case counts little.

    Of a single letter only the case may differ.
    """
    limit = max(min(len(name) - 1, 1), len(name) // 3)
    scored = []
    for candidate in set(known):
        if abs(len(candidate) - len(name)) <= limit:
            d = distance(name.lower(), candidate.lower())
            if d <= limit:
                scored.append((d, candidate != name, candidate))
    return [candidate for _, _, candidate in sorted(scored)[:count]]


def did_you_mean(name: str, known: Iterable[str], otherwise: str = "") -> str:
    """A hint naming the nearest known names, or `otherwise`."""
    found = nearest(name, known)
    return f"did you mean {' or '.join(found)}?" if found else otherwise
