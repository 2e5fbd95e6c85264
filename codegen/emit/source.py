"""The C file of a model: tables, functions, descriptor."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import DiscreteEquation, reads_arrival
from lacuna.codegen.dae.operators.transports import OPERATOR
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.asserts import assert_rows, can_be_violated
from lacuna.codegen.emit.callbacks.checks import Checks, least_sizes
from lacuna.codegen.emit.callbacks.continuous import Continuous
from lacuna.codegen.emit.callbacks.discrete import Discrete
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.callbacks.large import Large
from lacuna.codegen.emit.callbacks.stages import has_stages, with_stages
from lacuna.codegen.emit.callbacks.tables import Tables
from lacuna.codegen.emit.derivatives.tangents import Tangents
from lacuna.codegen.emit.functions.endless import calls
from lacuna.codegen.emit.functions.foreign import foreign_texts
from lacuna.codegen.emit.functions.prelude import helpers
from lacuna.codegen.emit.functions.user_functions import user_functions
from lacuna.codegen.emit.text.c_text import SourceNames, c_comment, c_string
from lacuna.codegen.emit.text.expression import number
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.causal import expressions_of
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.rewrite import expressions

_CALLBACKS = (
    "starts", "parameters", "samples", "initial_system", "rhs", "residual", "jacobian", "roots", "time_relations",
    "next_time_event", "event", "nominals", "divisions",
)  # fmt: skip
_DELAYS = {"delays": "mdl_delays", "delay_times": "mdl_delay_times", "delay_input": "mdl_delay_input",
           "delay_equation": "mdl_delay_equation"}  # fmt: skip
_TRANSPORTS = {key: f"mdl_{key}" for key in ("transports", "transport_initial", "transport_input", "transport_points")}
_SELDOM = ("branches", "lasting", "redundant", "delay", "transport")
_COUNTED = ("variables", "equations", "asserts", "messages", "z", "computed", "divisions", *_SELDOM)


def generate(prepared: Prepared, sensitivities: bool = False) -> str:
    """The C source of a prepared model, with its derivatives on request; the same bytes for the same model."""
    model, storage = prepared.model, prepared.storage
    if sensitivities and (prepared.delays or prepared.transports):
        hint, what = "vary parameters by finite differences of runs", "delay()" if prepared.delays else f"{OPERATOR}()"
        raise Diagnostic("R091", f"sensitivities of a model with {what} are outside the subset", model.span, hint)
    equations = EquationTable([row.source for row in prepared.system.rows])
    names = Names(model.variables)
    tables = Tables(prepared, equations)
    continuous = Continuous(prepared, names, equations)
    discrete = Discrete(prepared, names, tables.rows(), equations)
    checks = Checks(prepared, equations, names, tables.rows())
    large = Large(prepared, names, equations, tables.rows())
    functions = [
        large.parameters() or discrete.parameters(), large.starts() or continuous.starts(), discrete.samples(),
        *(with_stages(prepared, continuous.rhs()) if has_stages(prepared) else [large.rhs() or continuous.rhs()]),
        large.initial_system() or continuous.initial_system(),
        large.residual() or continuous.residual(), large.jacobian() or continuous.jacobian(),
        large.roots() or continuous.roots(), discrete.time_relations(), discrete.next_time_event(), discrete.event(),
        *([large.check() or continuous.check()] if can_be_violated(prepared) else []),
        checks.nominals(), checks.divisions(),
        *filter(None, [checks.phases(), large.guard_rates() or continuous.guard_rates()]),
        *checks.delays(), *checks.transports(),
    ]  # fmt: skip
    everything = expressions_of_model(prepared)
    tangents = Tangents(prepared, names, equations, tables.rows()) if sensitivities else None
    if tangents:
        functions += [*tangents.functions(), tangents.table(everything)]
        everything += tangents.gradients.coefficients()
    code = "\n\n".join(functions)
    called = user_functions(model.functions, calls(everything), names, assert_rows(prepared))
    code = "\n\n".join(filter(None, [called, code]))
    tables_text = "\n".join(constant_table(name, e) for e, name in names.tables.items())
    arrays, counts = _arrays(tables, checks, discrete.messages)
    counts |= {
        "n_p": len(storage.parameters), "n_u": len(storage.inputs), "n_x": len(storage.states),
        "n_v": len(storage.algebraics), "n_d": len(storage.discretes), "n_sample": len(prepared.samples),
        "n_when": discrete.when_count,
    }  # fmt: skip
    descriptor = _descriptor(prepared, counts, tangents is not None)
    parts = [
        _header(prepared, sensitivities),
        *foreign_texts(prepared.declared.foreign),
        *arrays,
        tables_text,
        helpers(code),
        code,
        descriptor,
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def expressions_of_model(prepared: Prepared) -> list[Expr]:
    """Everything that the model's own code computes."""
    model, form = prepared.model, prepared.residual
    roots: list[Expr] = [value for column in prepared.jacobian.entries for _, value in column]
    roots += [value for _, value in prepared.jacobian.tangents]
    roots += [e for row in form.residuals for e in (row.lhs, row.rhs)] + [a.value for a in form.assignments]
    roots += [e for step in (*prepared.explicit, *prepared.initial.steps) for e in expressions_of(step)]
    roots += [e for r in prepared.relations for e in (r.left, r.right)] + [e for s in prepared.samples for e in s]
    for step in prepared.events:
        roots += [step.value] if isinstance(step, DiscreteEquation) else expressions(
            [step] if isinstance(step, flat.When) else step.statements)  # fmt: skip
    roots += [d.seconds for d in prepared.delays] + [e for t in prepared.transports for e in (*t.points, *t.values)]
    roots += [*prepared.guards.phases, *prepared.guards.moving.values()]
    roots += [e for step in prepared.guards.steps for e in expressions_of(step)]
    roots += [*(a.condition for a in model.asserts)]
    roots += [e for v in model.variables.values() for e in (v.binding, v.start, v.min, v.max) if e is not None]
    return roots


def constant_table(name: str, e: Expr) -> str:
    """A constant array argument as a table of the file."""
    return f"static const double {name}[] = {{{', '.join(number(float(a.value)) for a in e.args)}}};"


def _header(prepared: Prepared, sensitivities: bool) -> str:
    files = "".join(f"\n *   {c_comment(name)}  sha256 {digest}" for name, digest in _files(prepared))
    return (
        f"/* {c_comment(prepared.declared.name)}: generated from{files}\n * Do not edit: edit the model. */\n"
        f'#include "mdl_{"tangent" if sensitivities else "abi"}.h"\n\n'
        "#include <math.h>\n#include <stddef.h>\n#include <string.h>"
    )


def _files(prepared: Prepared) -> list[tuple[str, str]]:
    return SourceNames().digests(prepared.declared.files.items())


def _arrays(tables: Tables, checks: Checks, messages: list[str]) -> tuple[list[str], dict[str, int]]:
    computed, divided = checks.computed(), checks.division_equations()  # which may add to the equations
    delayed = checks.delay_equations()
    first, variables = checks.equation_variables()
    contents = {
        "variables": ("mdl_variable mdl_variables", tables.variables()),
        "relations": ("mdl_relation mdl_relations", tables.relations()),
        "assert_values": ("int mdl_assert_values", tables.assert_values()),
        "asserts": ("mdl_assert mdl_asserts", tables.asserts()),
        "z": ("int mdl_z_index", tables.z_index()),
        "several": ("unsigned char mdl_z_branches", tables.z_branches()),
        "branches": ("mdl_computed mdl_branches", tables.branches()),
        "lasting": ("mdl_lasting mdl_lasting_rows", tables.lasting()),
        "redundant": ("mdl_computed mdl_redundant_rows", tables.redundant()),
        "residuals": ("int mdl_residual_equation", tables.residual_equations()),
        "p_start": ("double mdl_p_start", tables.parameter_starts()),
        "colptr": ("int mdl_jac_colptr", tables.column_pointers()),
        "rowidx": ("int mdl_jac_rowidx", tables.row_indices()),
        "messages": ("char *const mdl_messages", [c_string(text) for text in messages]),
        "equations": ("mdl_equation mdl_equations", tables.equations()),
        "computed": ("mdl_computed mdl_computed_by", computed),
        "first": ("int mdl_equation_first", first),
        "equation_variables": ("int mdl_equation_variables", variables),
        "divisions": ("int mdl_division_equation", divided),
        "affine": ("unsigned char mdl_affine_guards", tables.affine_guards()),
        "least": ("unsigned char mdl_least_sizes", least_sizes(checks.prepared)),
        "delay": ("int mdl_delay_input", checks.delay_inputs()),
        "delayed": ("int mdl_delay_equation", delayed),
        "transport": ("int mdl_transport_points", checks.transport_points()),
        "marks": ("int mdl_transport_input", checks.transport_inputs()),
    }
    arrays = [tables.array(declaration, rows) for declaration, rows in contents.values()]
    counts = {f"n_{key}": len(contents[key][1]) for key in _COUNTED if contents[key][1] or key not in _SELDOM}
    counts["n_shown"] = len(variables)
    counts["n_rel"], counts["jac_nnz"] = len(contents["relations"][1]), len(contents["rowidx"][1])
    return arrays, counts


def _follow(prepared: Prepared) -> list[str]:
    """What events read of continuous variables, as bits of the descriptor."""
    reads = {"MDL_FOLLOWS": prepared.events_follow, "MDL_ARRIVAL": reads_arrival(prepared.events)}
    return [bit for bit, does in reads.items() if does]


def _descriptor(prepared: Prepared, counts: dict[str, int], tangents: bool) -> str:
    experiment: flat.Experiment = prepared.declared.experiment
    shown = counts.pop("n_shown")
    fields = {
        "abi_version": "MDL_ABI_VERSION",
        "name": c_string(prepared.declared.name),
        "hash": c_string(prepared.hash),
        **{key: str(value) for key, value in sorted(counts.items())},
        "variables": _pointer("mdl_variables", counts["n_variables"]),
        "equations": _pointer("mdl_equations", counts["n_equations"]),
        "asserts": _pointer("mdl_asserts", counts["n_asserts"]),
        "relations": _pointer("mdl_relations", counts["n_rel"]),
        "messages": _pointer("mdl_messages", counts["n_messages"]),
        "z_index": _pointer("mdl_z_index", counts["n_z"]),
        "z_branches": _pointer("mdl_z_branches", counts["n_z"]),
        "residual_equation": _pointer("mdl_residual_equation", counts["n_x"] + counts["n_z"]),
        "p_start": _pointer("mdl_p_start", counts["n_p"]),
        "start_time": repr(float(experiment.start_time)),
        "stop_time": repr(float(experiment.stop_time)),
        "tolerance": repr(float(experiment.tolerance)),
        "interval": repr(float(experiment.interval or 0.0)),
        "jac_colptr": "mdl_jac_colptr",
        "jac_rowidx": _pointer("mdl_jac_rowidx", counts["jac_nnz"]),
        "computed": _pointer("mdl_computed_by", counts["n_computed"]),
        "equation_first": "mdl_equation_first",
        "equation_variables": _pointer("mdl_equation_variables", shown),
        "division_equation": _pointer("mdl_division_equation", counts["n_divisions"]),
        **{name: f"mdl_{name}" for name in _CALLBACKS},
        **_guards(prepared),
        **({"branches": "mdl_branches"} if "n_branches" in counts else {}),
        **({"lasting": "mdl_lasting_rows"} if "n_lasting" in counts else {}),
        **({"redundant": "mdl_redundant_rows"} if "n_redundant" in counts else {}),
        **({"events_follow": " | ".join(follow)} if (follow := _follow(prepared)) else {}),
        **(_DELAYS if prepared.delays else {}),
        **(_TRANSPORTS if prepared.transports else {}),
        **({"tangents": "&mdl_model_tangents"} if tangents else {}),
        **({"least_sizes": "mdl_least_sizes"} if least_sizes(prepared) else {}),
        **({"check": "mdl_check"} if can_be_violated(prepared) else {}),
        **({"stages": "mdl_stages"} if has_stages(prepared) else {}),
    }
    rows = "\n".join(f"  .{key} = {value}," for key, value in fields.items())
    return (
        f"static const mdl_descriptor mdl_model = {{\n{rows}\n}};\n\n"
        "const mdl_descriptor *mdl_descriptor_get(void);\n\n"
        "const mdl_descriptor *mdl_descriptor_get(void) { return &mdl_model; }"
    )


def _guards(prepared: Prepared) -> dict[str, str]:
    """How closely the guards are to be looked at, where the states alone do not tell."""
    shapes = prepared.guards
    phases = {"n_phases": str(len(shapes.phases)), "phases": "mdl_phases"} if shapes.phases else {}
    affine = {"affine_guards": "mdl_affine_guards", "guard_rates": "mdl_guard_rates"} if shapes.moving else {}
    return phases | ({"curved_guards": "1"} if shapes.curved else {}) | affine


def _pointer(name: str, count: int) -> str:
    return name if count else "NULL"
