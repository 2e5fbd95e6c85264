"""Everything that the C of a model is written from: the result of the passes."""

from __future__ import annotations

from dataclasses import dataclass

from . import flat
from .events import EventStep
from .expr import Expr
from .hybrid import Relation
from .initial import InitialSystem
from .storage import Storage
from .structure.causal import Step
from .structure.residual_form import Jacobian, ResidualForm
from .structure.system import System


@dataclass
class Prepared:
    declared: flat.FlatModel  # as flattened: its variables are the rows of the table
    aliases: dict[str, tuple[str, int]]
    system: System
    storage: Storage
    relations: list[Relation]
    samples: list[tuple[Expr, Expr]]
    events: list[EventStep]
    explicit: list[Step]
    residual: ResidualForm
    jacobian: Jacobian
    initial: InitialSystem
    hash: str = ""

    @property
    def model(self) -> flat.FlatModel:
        return self.system.model
