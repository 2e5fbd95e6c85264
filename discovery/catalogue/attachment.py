"""A hypothesis: an effect of the catalogue, or a law, at a place of the believed model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from lacuna.discovery.catalogue.catalogue import Effect
from lacuna.discovery.catalogue.places import Device, Line, Part, Shaft
from lacuna.discovery.efforts.places.sites import Site

OWN = "lacuna_"  # before names of what simulates a hypothesis and no reader sees: a machine has none such


class Empirical(Protocol):
    """What is asked of a law that no catalogue holds; `values` by its component's own names."""

    def expression(self, values: Mapping[str, float]) -> str:
        """In variables of the model."""

    def form(self, values: Mapping[str, float]) -> str:
        """The name of a known form that it has; "" where it has none."""

    def alike(self) -> tuple[str, str]:
        """The name of what it is not told from, and the variable to blame."""


@dataclass(frozen=True)
class Attachment:
    """An effect at a place. `values` are parameters that are written into the model (variants, whole numbers)."""

    effect: Effect
    component: str  # its name in the amended model
    location: str
    shaft: Shaft | None = None
    lines: tuple[Line, ...] = ()
    part: Part | None = None
    device: Device | None = None
    site: Site | None = None
    variable: str = ""  # of a sensor: the recorded variable
    signals: tuple[tuple[str, str], ...] = ()  # input of the effect -> variable of the model
    values: tuple[tuple[str, float], ...] = ()
    definition: str = ""  # source of the effect's class where it is in no library
    law: Empirical | None = None  # where the effect is of no catalogue

    @property
    def label(self) -> str:
        extra = "".join(f", {n}={v:g}" for n, v in self.values)
        signals = "".join(f", {n} from {v}" for n, v in self.signals)
        return f"{self.effect.identifier} at {self.location} ({self.effect.name}{extra}{signals})"

    def said(self, point: Mapping[str, float]) -> str:
        """The label; of a law the law with its numbers at a point, and its place."""
        if self.law is None:
            return self.label
        return f"{self.law.expression(self.own_values(point))} at {self.location}"

    @property
    def alike(self) -> tuple[str, str]:
        """The name of what it is not told from, and the variable that never turns."""
        return self.law.alike() if self.law else ("", "")

    def full_name(self, parameter: str) -> str:
        return f"{self.component}.{parameter}"

    def own_values(self, point: Mapping[str, float]) -> dict[str, float]:
        """The numbers of the effect or law at a point, by the names of its component."""
        return values_of(self.component, point)

    def contains(self, other: Attachment) -> bool:
        """Whether its law holds the other's, at the same place, as a special case."""
        return self.effect.identifier in other.effect.nests_in and self.location == other.location


def values_of(component: str, point: Mapping[str, float]) -> dict[str, float]:
    """What a point says of one component, by the component's own names."""
    prefix = f"{component}."
    return {n.removeprefix(prefix): v for n, v in point.items() if n.startswith(prefix)}
