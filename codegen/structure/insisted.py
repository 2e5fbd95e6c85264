"""stateSelect = always and never are no wishes: a model that cannot be had so is refused (Modelica 3.6, 4.9.8)."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.aliases import Aliases
from lacuna.codegen.structure.system import System
from lacuna.codegen.symbolic.expr import var
from lacuna.codegen.symbolic.leaves import leaves


def insist(declared: flat.FlatModel, aliases: Aliases, system: System) -> None:
    """Raises S014 where the states of `system` are not what the variables ask for; what is equal to a state is one.

    A state that never may be one stays where an equation could give it from other states: solutions do not depend on
    which of them stands for it."""
    states = set(system.states)
    for v in declared.variables.values():
        if v.state_select not in ("always", "never") or v.variability != flat.CONTINUOUS:
            continue
        name = aliases.representative.get(v.name, (v.name, 1))[0]
        is_state = str(system.renamed.expression(var(name)).value) in states
        if v.state_select == "always" and not is_state:
            hint = "no derivative of it is needed, or others determine it; write StateSelect.prefer"
            raise Diagnostic("S014", f"{v.name} cannot be a state, and must always be one", v.span, hint)
        if v.state_select == "never" and is_state and name == v.name and not _follows(name, system):
            hint = "its derivative is needed and nothing else can be the state; write StateSelect.avoid"
            raise Diagnostic("S014", f"{v.name} must be a state, and never may be one", v.span, hint)


def _follows(state: str, system: System) -> bool:
    """Whether an algebraic variable could take the place of the state: an equation without derivatives holds both."""
    derivatives, algebraics = set(system.derivatives), set(map(var, system.algebraics))
    rows = [leaves(row.lhs) | leaves(row.rhs) for row in system.rows]
    return any(var(state) in found and found & algebraics and not found & derivatives for found in rows)
