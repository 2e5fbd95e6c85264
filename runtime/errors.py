"""Refusals of this stage: a model that cannot be loaded, a name or a value that cannot be used."""

from __future__ import annotations

from collections.abc import Iterable

from lacuna.suggest import nearest, suggestion


class SimulationError(Exception):
    """Something the caller can put right; the message says what. A run that fails on its way raises nothing: its
    result is incomplete and says why."""

    user_error = True


class UnknownNameError(SimulationError):
    """A variable that the model does not have; the message offers the nearest names."""

    def __init__(self, what: str, name: str, valid: Iterable[str], where: str):
        known = list(valid)
        super().__init__(f"{where} has no {what} called {name}{suggestion(name, known)}")
        self.name, self.nearest = name, nearest(name, known)
