"""Which derivatives become algebraic: for every equation that was differentiated one.

S. Mattsson, G. Soderlind, Index reduction in DAEs using dummy derivatives, SIAM J. Sci. Comput. 14 (1993) 677-692.
The pivots are evaluated at the start values. Among good pivots stateSelect decides, then the order of derivative, then
whether the model itself has the derivative: such a variable is continuous, others may jump with what they follow. The
choice holds for the whole run where the pivots do not vary, or can be chosen so; else `dynamic_states` makes it anew
where it gets bad, or, where nothing else may be the state, an assert of `tangents` watches it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import reduce

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.aliases import STATE_SELECT
from lacuna.codegen.structure.index.dynamic_states import Resets, Selection
from lacuna.codegen.structure.index.pivots import Elimination, Pivot, base_of, text_of
from lacuna.codegen.structure.index.tangents import Group, Watch
from lacuna.codegen.structure.nominal import infer
from lacuna.codegen.structure.sizes import told
from lacuna.codegen.structure.system import DeclaredValues, DefinedValues, GenericValues, Row, System
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import ONE, Expr, const, der, is_const, maximum, mul, var
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter, all_statements
from lacuna.codegen.symbolic.union_find import UnionFind


def choose_states(model: flat.FlatModel, rows: list[Row], names: list[str], relations: int) -> System:
    """Select dummy derivatives among `rows` and return the system in the remaining states. `relations`: how many the
    model has, which those of a dynamic choice are counted from."""
    variables = _variables(rows, names)
    choice = _first_choice(model, rows, variables)
    system = _system(model, rows, names, variables, choice, [], [])
    if not choice.groups and not choice.watched:
        return system
    sizes = _sizes(system, [*choice.groups, *choice.watched])
    selections = [Selection(k + 1, g, model, sizes) for k, g in enumerate(choice.groups)]
    watches = [
        Watch(len(selections) + k + 1, g, _beside_states(model, g, sizes, choice.slopes))
        for k, g in enumerate(reversed(choice.watched))
    ]
    algorithms = [s.algorithm(relations + k) for k, s in enumerate(selections)]
    more = {name: v for s in (*selections, *watches) for name, v in s.variables.items()}
    model = replace(
        Resets(selections).model(model),
        variables=model.variables | more,
        algorithms=[*model.algorithms, *algorithms],
        asserts=[*model.asserts, *(w.condition(_reinitialised(model)) for w in watches)],
    )
    return _system(model, rows, names, variables, choice, selections, watches)


def _first_choice(model: flat.FlatModel, rows: list[Row], variables: dict[Expr, int]) -> _Choice:
    """At the start values as far as they tell; else at those of their neighbourhood."""
    for values in (DeclaredValues(model), DefinedValues(model, rows)):
        try:
            return _Choice(model, variables, values).of(rows)
        except Diagnostic:
            continue
    return _Choice(model, variables, GenericValues(model, rows)).of(rows)


def _system(
    model: flat.FlatModel, rows: list[Row], names: list[str], variables: dict[Expr, int], choice: _Choice,
    selections: list[Selection], watches: list[Watch],
) -> System:  # fmt: skip
    """With the states of `selections` in place of those that were chosen for the start."""
    free = {d for g in choice.groups for d in g.free} if selections else set()
    dummies = choice.dummies | free
    replacement, model, extra = _rename(model, variables, dummies, free)
    rewriter = Rewriter(replacement.get)
    new_rows: dict[Row, Row] = {}
    for row in rows:
        integral = new_rows[row.integral] if row.integral else None
        new_rows[row] = Row(rewriter.expression(row.lhs), rewriter.expression(row.rhs), row.source, integral)
    for s in (*selections, *watches):
        extra += [Row(rewriter.expression(r.lhs), rewriter.expression(r.rhs), r.source) for r in s.rows()]
    states = [str(s.value) for v in variables if der(v) in variables and der(v) not in dummies
              for s in [replacement.get(v, v)]]  # fmt: skip
    states += [name for s in selections for name in s.states]
    own = (n for s in (*selections, *watches) for n, v in s.variables.items() if v.variability == flat.CONTINUOUS)
    all_names = dict.fromkeys([*names, *(str(n.value) for n in replacement.values() if n.op == "var"), *own])
    state_set = set(states)
    return System(
        rewriter.model(model),
        [*new_rows.values(), *extra],
        states,
        [n for n in all_names if n not in state_set],
        [text_of(d) for d in variables if d in dummies],
        rewriter,
        [s.switch().rewritten(rewriter) for s in selections],
        [name for s in selections for name in s.states],
        [str(rewriter.expression(d.args[0]).value) for s in selections for d in s.group.selected],
        [(rewriter.expression(d.args[0]), rewriter.expression(d)) for d in variables if d in dummies],
    )


def _sizes(system: System, groups: Sequence[Group]) -> dict[Expr, Expr]:
    """Nominal values of the candidates, one for all of a group that have one unit, or that a constraint holds equal
    but for the sign: none is the better state because it starts at zero. Where nothing is known it is 1 in the unit."""
    known, found = infer(system, []), {}
    for g in groups:
        alike = UnionFind()
        for d in (*g.free, *g.others):
            base, order = base_of(d), text_of(d).count("der(")
            alike.join(d, (system.model.variables[str(base.value)].unit, order))
        for row in g.rows:
            held = [d for d in (*g.free, *g.others) if d in row.leaves]
            slopes = [partial(row.residual, d) for d in held]
            if len(held) == 2 and all(is_const(s, 1) or is_const(s, -1) for s in slopes):
                alike.join(*held)
        by_root: dict[object, list[Expr]] = {}
        for d in (*g.free, *g.others):
            by_root.setdefault(alike.find(d), []).append(d.args[0])
        for candidates in by_root.values():
            sizes = [told(known[n]) for q in candidates if (n := system.renamed.expression(q)) in known]
            found |= dict.fromkeys(candidates, reduce(maximum, dict.fromkeys(sizes)) if sizes else ONE)
    return found


def _beside_states(
    model: flat.FlatModel, group: Group, sizes: dict[Expr, Expr], slopes: dict[Expr, dict[Expr, float]]
) -> dict[Expr, Expr]:
    """The size of each candidate of a group that is watched, by its derivative. Guesses of sizes in one unit compare,
    those in several do not: in another unit than the states' they are at least what the states move at the start."""
    kinds: dict[tuple[str, int], list[Expr]] = {}
    for d in (*group.free, *group.others):
        kinds.setdefault((model.variables[str(base_of(d).value)].unit, text_of(d).count("der(")), []).append(d)
    found = {}
    for alike in kinds.values():
        moved = [
            mul(const(slope), sizes[state.args[0]])
            for state in ([] if set(alike) & set(group.selected) else group.selected)
            if (slope := max(abs(slopes[d].get(state, 0.0)) for d in alike))
        ]
        found |= {d: reduce(maximum, moved, sizes[d.args[0]]) for d in alike}
    return {d: found[d] for d in (*group.free, *group.others)}


def _variables(rows: list[Row], names: list[str]) -> dict[Expr, int]:
    """Every unknown and derivative of one that occurs, with its order of differentiation; in declaration order."""
    highest: dict[str, int] = {}
    for row in rows:
        for n in row.leaves:
            if n.op == "der":
                name, order = str(base_of(n).value), text_of(n).count("der(")
                highest[name] = max(order, highest.get(name, 0))
    found: dict[Expr, int] = {}
    for name in names:
        n = var(name)
        found[n] = 0
        for order in range(1, highest.get(name, 0) + 1):
            n = der(n)
            found[n] = order
    return found


@dataclass
class _Choice:
    """Derivatives that become algebraic, groups whose states are chosen in the run, and those whose are watched."""

    model: flat.FlatModel
    variables: dict[Expr, int]
    values: DeclaredValues
    dummies: set[Expr] = field(default_factory=set)
    groups: list[Group] = field(default_factory=list)
    watched: list[Group] = field(default_factory=list)
    slopes: dict[Expr, dict[Expr, float]] = field(default_factory=dict)  # of what is determined by what is not

    def of(self, rows: list[Row]) -> _Choice:
        """From the highest derivatives down: what stands for a constraint's derivative may do so for its integral."""
        self._reset = _reinitialised(self.model)
        self._together = _held_together(rows, self.variables)
        self._written = {n for row in rows if row.integral is None for n in row.leaves if n.op == "der"}
        differentiated = {row.integral for row in rows if row.integral}
        constraints = [row for row in rows if row.integral and row not in differentiated]
        candidates = [v for v in self.variables if self.variables[v] and der(v) not in self.variables]
        while constraints:
            chosen = self._level(constraints, candidates)
            candidates = [v.args[0] for v in self.variables if v in chosen and self.variables[v] > 1]
            constraints = [row.integral for row in constraints if row.integral.integral]
        return self

    def _level(self, rows: list[Row], candidates: list[Expr]) -> set[Expr]:
        """Derivatives of one level that are algebraic, at least for some time."""
        elimination = Elimination(self.model, rows, candidates, self.values, self._strength)
        pivots = elimination.run()
        if len(pivots) < len(candidates) and any(p.varies for p in pivots.values()):
            elimination = Elimination(self.model, rows, candidates, self.values, self._strength)
            pivots = elimination.run(steady_first=True)
        self.slopes |= elimination.slopes()
        chosen = {p.column for p in pivots.values()}
        self.dummies |= chosen
        for group in self._groups(rows, pivots, candidates):
            if len(group.free) > len(group.selected):
                self.groups.append(group)
                chosen |= set(group.free)
            elif group.selected:
                self.watched.append(group)
        return chosen

    def _groups(self, rows: list[Row], pivots: dict[Row, Pivot], candidates: list[Expr]) -> list[Group]:
        """The constraints that hang together with one whose pivot varies."""
        parts, position = UnionFind(), {v: k for k, v in enumerate(candidates)}
        for row in rows:
            for v in row.leaves:
                if v in position:
                    parts.join(row, v)
        found = []
        for root in dict.fromkeys(parts.find(row) for row in rows if pivots[row].varies):
            own = [row for row in rows if parts.find(row) == root]
            columns = [v for v in candidates if v in parts.parent and parts.find(v) == root]
            determined = {pivots[row].column: pivots[row].varies for row in own}
            reset = self._movable(own, columns) if len(columns) == len(own) + 1 else None
            states = [v for v in columns if v not in determined]
            selected = [v for v in states if v is reset or not self._is_fixed(v)]
            free = [v for v in columns if v in selected or (determined.get(v) and not self._is_never(v))]
            if len(free) == len(selected) or not selected:
                selected = free = states
            others = [v for v in columns if v in determined and v not in free]
            found.append(Group(own, free, others, selected, reset if len(free) > len(selected) else None))
        return found

    def _movable(self, rows: list[Row], columns: list[Expr]) -> Expr | None:
        """The one candidate that a reinit sets, where no other of its constraints' variables is set so, and these are
        linear in it."""
        root = self._together.find(base_of(columns[0]))
        held = [v for v in self.variables if not self.variables[v] and v in self._together.parent]
        reset = [v for v in held if self._together.find(v) == root and v.value in self._reset]
        own = [d for d in columns if d.args[0] in reset]
        if len(reset) != 1 or not own or self.model.variables[str(reset[0].value)].state_select == "always":
            return None
        moving = {d.args[0] for d in columns}
        slopes = (partial(row.residual, d) for row in rows for d in columns if d in row.leaves)
        return own[0] if all(moving.isdisjoint(leaves(slope)) for slope in slopes) else None

    def _is_fixed(self, v: Expr) -> bool:
        base = self.model.variables[str(base_of(v).value)]
        return base.name in self._reset or base.state_select == "always"

    def _is_never(self, v: Expr) -> bool:
        return self.model.variables[str(base_of(v).value)].state_select == "never"

    def _strength(self, derivative: Expr) -> tuple:
        """Derivatives with the smallest become dummies first."""
        v = self.model.variables[str(base_of(derivative).value)]
        fixed = v.fixed is not None and v.fixed.op == "const" and bool(v.fixed.value)
        order = self.variables[derivative]
        return v.name in self._reset, STATE_SELECT.index(v.state_select), -order, derivative in self._written, fixed


def _held_together(rows: list[Row], variables: dict[Expr, int]) -> UnionFind:
    """Variables that have derivatives, by the constraints that hold them, at all levels."""
    found = UnionFind()
    for row in rows:
        held = [base_of(n) for n in row.leaves if n in variables and (variables[n] or der(n) in variables)]
        for v in held[1:] if row.integral else []:
            found.join(held[0], v)
    return found


def _reinitialised(model: flat.FlatModel) -> set[str]:
    """Targets of reinit: they must be states."""
    return {s.target for s in all_statements([*model.whens, *(s for a in model.algorithms for s in a.statements)])
            if isinstance(s, flat.Reinit)}  # fmt: skip


def _rename(
    model: flat.FlatModel, variables: dict[Expr, int], dummies: set[Expr], free: set[Expr]
) -> tuple[dict[Expr, Expr], flat.FlatModel, list[Row]]:
    """Derivatives that are dummies or states themselves, or become states (the integrals of `free`), become variables
    named "der(x)"."""
    replacement: dict[Expr, Expr] = {}
    extra: list[Row] = []
    declared = dict(model.variables)
    for n, order in variables.items():
        if not order:
            continue
        inner = replacement.get(n.args[0], n.args[0])
        is_state = der(n) in variables and (der(n) not in dummies or der(n) in free)
        if n not in dummies and not is_state:
            if inner is not n.args[0]:
                replacement[n] = der(inner)
            continue
        name = text_of(n)
        replacement[n] = var(name)
        base = model.variables[str(base_of(n).value)]
        unit = f"{base.unit}/s{order if order > 1 else ''}" if base.unit else ""
        declared[name] = flat.Variable(name, base.span, unit=unit, description=f"derivative of {base.name}")
        if n not in dummies:
            source = flat.Equation(der(inner), var(name), base.span, "", f"{text_of(der(inner))} = {name}")
            extra.append(Row(der(inner), var(name), source))
    return replacement, replace(model, variables=declared), extra
