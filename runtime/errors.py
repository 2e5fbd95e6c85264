"""Refusals of this stage: a model that cannot be loaded, a name or a value that cannot be used."""

from __future__ import annotations

from collections.abc import Iterable
import difflib

CLOSE, SHOWN, LISTED = 0.5, 3, 5  # similarity from which a name may be a slip; how many are shown, of either kind


class SimulationError(Exception):
    """Something the caller can put right; the message says what. A run that fails on its way raises nothing: its
    result is incomplete and says why."""

    user_error = True


class UnknownNameError(SimulationError):
    """A variable that the model does not have; the message offers the nearest names."""

    def __init__(self, what: str, name: str, valid: Iterable[str], where: str):
        known = list(valid)
        super().__init__(f"{where} has no {what} called {name}{suggestion(name, known)}")
        self.name, self.nearest = name, close_names(name, known)


def suggestion(name: str, valid: Iterable[str]) -> str:
    """The end of a refusal of `name`: names that may be meant, or else some that there are, the nearest first."""
    known = list(valid)
    close = close_names(name, known)
    if close:
        return f"; did you mean {' or '.join(close)}?"
    if not known:
        return "; there is none"
    more = f" and {len(known) - LISTED} more" if len(known) > LISTED else ""
    return f"; there {'is' if len(known) == 1 else 'are'} {', '.join(_ranked(name, known)[:LISTED])}{more}"


def close_names(name: str, known: list[str]) -> list[str]:
    return [k for k in _ranked(name, known) if _likeness(name, k) >= CLOSE][:SHOWN]


def _ranked(name: str, known: list[str]) -> list[str]:
    return sorted(known, key=lambda k: -_likeness(name, k))


def _likeness(name: str, known: str) -> float:
    """0 to 1, of the whole names or, a little less, of what stands after the last dot: R is like winding.R."""
    whole = difflib.SequenceMatcher(None, known, name).ratio()
    last = difflib.SequenceMatcher(None, known.rpartition(".")[2], name.rpartition(".")[2]).ratio()
    return max(whole, 0.9 * last)
