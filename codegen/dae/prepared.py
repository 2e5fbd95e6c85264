"""Everything that the C of a model is written from: the result of the passes."""

from __future__ import annotations

from dataclasses import dataclass, field

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import EventStep
from lacuna.codegen.dae.divisions import Quotient
from lacuna.codegen.dae.guards import GuardShapes
from lacuna.codegen.dae.initial import InitialSystem
from lacuna.codegen.dae.operators.delays import Delay
from lacuna.codegen.dae.operators.transports import Transport
from lacuna.codegen.dae.relations import Relation
from lacuna.codegen.dae.storage import Storage
from lacuna.codegen.structure.causal import Step
from lacuna.codegen.structure.residual_form import Jacobian, ResidualForm
from lacuna.codegen.structure.sizes import Size
from lacuna.codegen.structure.system import System
from lacuna.codegen.symbolic.expr import Expr


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
    nominals: dict[Expr, Size]  # sizes of variables and derivatives
    divisions: list[Quotient]
    guards: GuardShapes
    delays: list[Delay] = field(default_factory=list)
    transports: list[Transport] = field(default_factory=list)
    events_follow: bool = False  # through equations or relations, what they set themselves
    followers: frozenset[int] = frozenset()  # numbers of relations, see followers.py
    hash: str = ""

    @property
    def model(self) -> flat.FlatModel:
        return self.system.model
