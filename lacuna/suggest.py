"""'Did you mean ...': the known names nearest to one that was not found, for every stage."""

from __future__ import annotations

from collections.abc import Iterable

SHOWN, LISTED = 3, 5  # near names; names at all, where none is near


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


def nearest(name: str, known: Iterable[str], count: int = SHOWN) -> list[str]:
    """Up to `count` names that may be meant, the nearest first: at most about a third of the length away, or that go on
    where `name` ends. Case counts little; of a single letter only the case may differ. Of dotted names the last parts
    may be near instead: R is like winding.R."""
    scored = [(far, candidate != name, candidate) for candidate in set(known) if (far := _far(name, candidate))]
    return [candidate for _, _, candidate in sorted(scored)[:count]]


def _far(name: str, candidate: str) -> tuple[int, int] | None:
    """How far, whole names first; None: too far."""
    whole = _slip(name, candidate)
    if whole is not None:
        return whole, 0
    last = _slip(name.rpartition(".")[2], candidate.rpartition(".")[2]) if "." in name + candidate else None
    return None if last is None else (last, 1)


def _slip(name: str, candidate: str) -> int | None:
    limit = max(min(len(name) - 1, 1), len(name) // 3)
    a, b = name.lower(), candidate.lower()
    if abs(len(a) - len(b)) <= limit and (d := distance(a, b)) <= limit:
        return d
    return limit + 1 if len(a) > 2 and b.startswith(a) else None


def question(names: Iterable[str]) -> str:
    return f"did you mean {' or '.join(names)}?"


def did_you_mean(name: str, known: Iterable[str], otherwise: str = "") -> str:
    """A hint naming the nearest known names, or `otherwise`."""
    found = nearest(name, known)
    return question(found) if found else otherwise


def suggestion(name: str, valid: Iterable[str]) -> str:
    """The end of a refusal of `name`: names that may be meant, or else some that there are."""
    known = list(valid)
    if not known:
        return "; there is none"
    more = f" and {len(known) - LISTED} more" if len(known) > LISTED else ""
    listed = f"there {'is' if len(known) == 1 else 'are'} {', '.join(known[:LISTED])}{more}"
    return f"; {did_you_mean(name, known, listed)}"
