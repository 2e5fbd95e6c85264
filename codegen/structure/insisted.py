"""stateSelect = always and never are no wishes: a model that cannot be had so is refused (Modelica 3.6, 4.9.8)."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.aliases import Aliases
from lacuna.codegen.structure.system import System
from lacuna.codegen.symbolic.expr import Expr, var
from lacuna.codegen.symbolic.leaves import leaves


def insist(declared: flat.FlatModel, aliases: Aliases, system: System) -> None:
    """Raises S014 where the states of `system` are not what the variables ask for; what is equal to a state is one.

    Where an equation holds a variable beside others, these may be states in its place or it in theirs: solutions do not
    depend on which of them stands for it, and the choice of states stays as it is."""
    states = set(system.states)
    for v in declared.variables.values():
        if v.state_select not in ("always", "never") or v.variability != flat.CONTINUOUS:
            continue
        name = aliases.representative.get(v.name, (v.name, 1))[0]
        present = system.renamed.expression(var(name))
        is_state = str(present.value) in states
        if v.state_select == "always" and not is_state and not _stands_beside(present, system, derivatives=True):
            hint = "no derivative of it is needed, or others determine it; write StateSelect.prefer"
            raise Diagnostic("S014", f"{v.name} cannot be a state, and must always be one", v.span, hint)
        own = is_state and name == v.name
        if v.state_select == "never" and own and not _stands_beside(present, system, derivatives=False):
            hint = "its derivative is needed and nothing else can be the state; write StateSelect.avoid"
            raise Diagnostic("S014", f"{v.name} must be a state, and never may be one", v.span, hint)


def _stands_beside(e: Expr, system: System, derivatives: bool) -> bool:
    """Whether an equation, with `derivatives` or without, holds `e` beside another variable to be solved for."""
    others = set(system.unknowns if derivatives else map(var, system.algebraics)) | set(map(var, system.states))
    rates = set(system.derivatives)
    rows = (leaves(row.lhs) | leaves(row.rhs) for row in system.rows)
    return any(e in found and found & (others - {e}) and (derivatives or not found & rates) for found in rows)
