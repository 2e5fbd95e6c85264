"""The constant tables of a generated model: variables, equations, relations, patterns, start values."""

from __future__ import annotations

from collections.abc import Sequence

from lacuna.codegen import flat
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.dae.relations import asked
from lacuna.codegen.dae.storage import Slot
from lacuna.codegen.emit.callbacks.asserts import all_asserts, shown_values
from lacuna.codegen.emit.callbacks.discrete import is_settable
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.text.c_text import SourceNames, c_string
from lacuna.codegen.emit.text.expression import number
from lacuna.codegen.errors import Span
from lacuna.codegen.structure.causal import NonlinearBlock, expressions_of, of_nonlinear
from lacuna.codegen.structure.system import DeclaredValues, System
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.leaves import leaves

_STORAGE = {"x": "STATE", "v": "ALGEBRAIC", "d": "DISCRETE", "p": "PARAMETER", "u": "INPUT"}


def _rates(system: System) -> set[Expr]:
    """Derivatives of what is no state, and the variables that equations say they are, of either sign."""
    rates = {derivative for _, derivative in system.differentiated}
    sides = [{s.args[0] if s.op == "neg" else s for s in (row.lhs, row.rhs)} for row in system.rows]
    return rates.union(*(pair for pair in sides if pair & rates and all(s.op == "var" for s in pair)))


class Tables:
    def __init__(self, prepared: Prepared, equations: EquationTable):
        self._p, self._equations = prepared, equations
        self._values = DeclaredValues(prepared.model)
        self._file = SourceNames()

    def array(self, declaration: str, rows: Sequence[str]) -> str:
        """`static const <declaration>[] = {...};`, or nothing where there are no rows (C has no empty arrays)."""
        if not rows:
            return ""
        body = ",\n  ".join(rows)
        return f"static const {declaration}[] = {{\n  {body}\n}};"

    def slot(self, name: str) -> tuple[Slot, int] | None:
        """(slot, sign) of a declared variable."""
        target, sign = self._p.aliases.get(name, (name, 1))
        slot = self._p.storage.slot(target)
        return (slot, sign) if slot else None

    def variables(self) -> list[str]:
        return [self._variable(v) for v in self._p.declared.variables.values() if self.slot(v.name)]

    def rows(self) -> dict[str, int]:
        """Index of each declared variable in the table."""
        names = [n for n in self._p.declared.variables if self.slot(n)]
        return {n: k for k, n in enumerate(names)}

    def _variable(self, v: flat.Variable) -> str:
        slot, sign = self.slot(v.name)
        target = self._p.aliases.get(v.name, (v.name, 1))[0]
        final = self._p.model.variables[target]
        start = self._number(self._values.variable(target), 0.0)
        least, most = (1.0, float(len(v.enumeration))) if v.enumeration else (float("-inf"), float("inf"))
        limits = [
            number(self._number(self._values(e) if e is not None and not self._moves(e) else None, default))
            for e, default in ((v.min, least), (v.max, most), (v.nominal, 0.0))
        ]
        fields = [
            c_string(v.name), c_string(v.unit), c_string(v.description), self._place(v.span),
            f"MDL_{v.type.upper()}", f"MDL_{_STORAGE[slot.array]}", str(slot.index), str(sign),
            str(int(slot.array == "p" and is_settable(final))), str(int(v.causality == "output")),
            number(sign * start), *limits, c_string(v.inferred_unit),
            str(int(v.variability in (flat.CONSTANT, flat.PARAMETER))),
        ]  # fmt: skip
        return "{" + ", ".join(fields) + "}"

    def _place(self, span: Span) -> str:
        return f"{c_string(self._file(span.file))}, {span.line}"

    def _moves(self, limit: Expr) -> bool:
        """Whether a bound follows parameters that may be set: then it holds for their values, not the declared ones."""
        names = (str(n.value) for n in leaves(limit) if n.op == "var")
        used = [self._p.model.variables[self._p.aliases.get(n, (n, 1))[0]] for n in names]
        return any(is_settable(v) or (v.binding is not None and self._moves(v.binding)) for v in used)

    @staticmethod
    def _number(value: float | int | bool | None, default: float) -> float:
        return default if value is None else float(value)

    def equations(self) -> list[str]:
        return [self._source(e) for e in self._equations.entries]

    def _source(self, e: flat.Equation, text: str | None = None) -> str:
        text = text if text is not None else e.text or f"{e.lhs} = {e.rhs}"
        text = " ".join(text.split())
        return f"{{{c_string(text)}, {self._place(e.span)}, {c_string(e.origin)}}}"

    def asserts(self) -> list[str]:
        first, result = 0, []
        for a, shown in zip(all_asserts(self._p), self._shown(), strict=True):
            source = f"{{{c_string(a.message)}, {self._place(a.span)}, {c_string(a.origin)}}}"
            values = f"mdl_assert_values + {first}" if shown else "NULL"
            result.append(f"{{{source}, {len(shown)}, {values}}}")
            first += len(shown)
        return result

    def assert_values(self) -> list[str]:
        return [str(row) for rows in self._shown() for row in rows]

    def _shown(self) -> list[list[int]]:
        rows = self.rows()
        return [[rows[name] for name in names if name in rows] for names in shown_values(self._p)]

    def relations(self) -> list[str]:
        follows, always = self._p.followers, asked(self._evaluated())
        kinds = [
            int(r.slope is not None) + 2 * (k in follows) + 4 * (k in always) for k, r in enumerate(self._p.relations)
        ]
        return [f"{{{self._source(r.source, r.text)}, {n}}}" for r, n in zip(self._p.relations, kinds, strict=True)]

    def _evaluated(self) -> list[Expr]:
        conditions = [step.branches[0][0] for step in self._p.events if isinstance(step, flat.When)]
        return [*conditions, *(e for step in self._p.explicit for e in expressions_of(step))]

    def affine_guards(self) -> list[str]:
        moving = self._p.guards.moving
        return [str(int(k in moving)) for k in range(len(self._p.relations))] if moving else []

    def residual_equations(self) -> list[str]:
        return [str(self._equations.index(row.source)) for row in self._p.residual.residuals]

    def z_index(self) -> list[str]:
        return [str(self._p.storage.slot(str(z.value)).index) for z in self._p.residual.tears]

    def z_branches(self) -> list[str]:
        several = of_nonlinear(self._p.explicit)
        return [str(int(z in several)) for z in self._p.residual.tears]

    def branches(self) -> list[str]:
        """The unknowns of nonlinear blocks that their solver starts from."""
        blocks = [step for step in self._p.explicit if isinstance(step, NonlinearBlock)]
        starts = [(u, self._equations.index(b.residuals[0].source)) for b in blocks for u in b.tears]
        return [f"{{{self._kept(u)}, {equation}}}" for u, equation in starts]

    def redundant(self) -> list[str]:
        """Fixed start values that other initial conditions determine."""
        return [f"{{{self._kept(e.lhs)}, {self._equations.index(e)}}}" for e in self._p.initial.redundant]

    def _kept(self, unknown: Expr) -> str:
        derivative = unknown.op == "der"
        slot = self._p.storage.slot(str((unknown.args[0] if derivative else unknown).value))
        return f"MDL_{'DERIVATIVE' if derivative else _STORAGE[slot.array]}, {slot.index}"

    def lasting(self) -> list[str]:
        """What has a derivative and is no state, where an equation that was differentiated switches at events, but
        for rates, which may jump at a corner of an imposed motion: the impulse is in their own rate alone. With
        noDerivative the model says itself that its derivatives are what they are wherever values jump."""
        system = self._p.system
        rows = [row.integral for row in system.rows if row.integral is not None]
        switching = [row for row in rows if any(map(self._of_events, row.leaves))]
        promised = any(rule.unheard for rules in self._p.declared.derivatives.values() for rule in rules)
        if not switching or promised:
            return []
        equation, found = self._equations.index(switching[0].source), []
        rates = _rates(system)
        for n, derivative in system.differentiated:
            if n in rates:
                continue
            slots = [self._p.storage.slot(str(e.value)) for e in (n, derivative) if e.op == "var"]
            if len(slots) == 2 and all(slot is not None and slot.array == "v" for slot in slots):
                found.append(f"{{{slots[0].index}, {slots[1].index}, {equation}}}")
        return found

    def _of_events(self, n: Expr) -> bool:
        return n.op in ("rel", "tick", "pre") or self._p.storage.is_discrete(n)

    def parameter_starts(self) -> list[str]:
        return [number(self._number(self._values.variable(n), 0.0)) for n in self._p.storage.parameters]

    def column_pointers(self) -> list[str]:
        pointers = [0]
        for column in self._p.jacobian.entries:
            pointers.append(pointers[-1] + len(column))
        return [str(k) for k in pointers]

    def row_indices(self) -> list[str]:
        return [str(row) for column in self._p.jacobian.entries for row, _ in column]
