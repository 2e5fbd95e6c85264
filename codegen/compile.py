"""From a model's name to a compiled model: the list of passes, and nothing else."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
import gc
import sys
import threading
import time
from typing import TypeVar

from lacuna.codegen import cache, flat
from lacuna.codegen.dae import hybrid
from lacuna.codegen.dae.discrete import events
from lacuna.codegen.dae.discrete.discrete_starts import discrete_starts
from lacuna.codegen.dae.discrete.first_values import first_values
from lacuna.codegen.dae.discrete.followers import followers
from lacuna.codegen.dae.discrete.one_instant import one_instant
from lacuna.codegen.dae.discrete.reinits_at_start import reinits_at_start
from lacuna.codegen.dae.divisions import divisions
from lacuna.codegen.dae.free_parameters import free_parameters
from lacuna.codegen.dae.guards import guard_shapes
from lacuna.codegen.dae.initial import initial_system
from lacuna.codegen.dae.operators import delays, homotopy, transports
from lacuna.codegen.dae.operators.held_inputs import hold_inputs
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.dae.relations import Relation, rename
from lacuna.codegen.dae.storage import Storage
from lacuna.codegen.dae.unassigned import leave_unread
from lacuna.codegen.emit.source import generate
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.access import NONE, Access
from lacuna.codegen.library.classes import Library
from lacuna.codegen.structure.aliases import eliminate_aliases
from lacuna.codegen.structure.causal import causalise
from lacuna.codegen.structure.constants import precompute, precompute_inverses
from lacuna.codegen.structure.index.index_reduction import reduce_index
from lacuna.codegen.structure.insisted import insist
from lacuna.codegen.structure.nominal import infer
from lacuna.codegen.structure.residual_form import jacobian, residual_form
from lacuna.codegen.structure.sorting.tearing import Tearing
from lacuna.codegen.structure.system import DeclaredValues
from lacuna.codegen.symbolic.expr import Expr, own_table

T = TypeVar("T")
_translating = threading.Lock()  # expressions are shared by all threads; one translation at a time keeps them unique
Modifications = Mapping[str, Expr | float]


@dataclass
class Report:
    """Seconds of each pass (empty where the model came from the cache) and warnings."""

    seconds: dict[str, float] = field(default_factory=dict)
    warnings: list[Diagnostic] = field(default_factory=list)
    cached: bool = False

    def run(self, name: str, work: Callable[..., T], *args: object) -> T:
        start = time.perf_counter()
        result = work(*args)
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - start
        return result


@dataclass
class CompiledModel:
    name: str
    path: str  # of the shared library
    hash: str  # of everything that decides the generated code
    report: Report


@contextmanager
def _uncollected() -> Iterator[None]:
    """No search for garbage cycles meanwhile: nodes and rows stay as long as the translation does, and to look through
    ever more of them in vain takes a third of its time."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


def prepare(declared: flat.FlatModel, report: Report) -> Prepared:
    """The structural passes, in order."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), 20000))
    declared = leave_unread(report.run("initial system", free_parameters, declared))
    aliases = report.run("aliases", eliminate_aliases, hold_inputs(declared))
    split = report.run("initial system", homotopy.split, aliases.model)
    split, delayed = report.run("hybrid", delays.split, split)
    split, carried = report.run("hybrid", transports.split, split)
    split = report.run("initial system", reinits_at_start, split)
    split = report.run("initial system", first_values, split)
    frozen = report.run("hybrid", hybrid.analyse, split)
    report.warnings += report.run("hybrid", one_instant, frozen.model, frozen.relations)
    model = report.run("initial system", discrete_starts, frozen.model)
    continuous, discrete = report.run("hybrid", events.split, model)
    system = report.run("index reduction", reduce_index, model, continuous, len(frozen.relations))
    insist(declared, aliases, system)
    system = report.run("aliases", precompute, system)
    relations = report.run("hybrid", rename, frozen.relations, system.renamed)
    relations += [Relation(s.left, s.right, s.source, text=s.text) for s in system.switches]
    steps = report.run("hybrid", events.order, system.model, discrete, system.renamed, system.algebraics)
    events.refuse_reinit(steps, system.states)
    tearing = Tearing(DeclaredValues(system.model))
    explicit = report.run("matching, BLT, tearing", causalise, system.rows, system.unknowns, tearing)
    compare = report.run("hybrid", followers, steps, explicit, relations)
    repeated = report.run("hybrid", events.follow, steps, explicit) or bool(compare)
    residual = report.run("residual form", residual_form, system, explicit, tearing)
    matrix = report.run("jacobian", jacobian, residual, system)
    initial = report.run("initial system", initial_system, system, system.model.initial_equations, tearing)
    explicit, system = report.run("matching, BLT, tearing", precompute_inverses, explicit, system)
    compared = [(r.left, r.right, _line(r)) for r in relations]
    sizes = report.run("nominal values", infer, system, compared, delayed)
    quotients = report.run("divisions", divisions, explicit, system.model)
    shapes = report.run("guards", guard_shapes, explicit, relations, system.model, system.states)
    report.warnings += [*declared.warnings, *initial.warnings]
    return Prepared(
        declared, aliases.representative, system, Storage(system), relations, frozen.samples, steps, explicit,
        residual, matrix, initial, sizes, quotients, shapes, delayed, carried, repeated, compare,
    )  # fmt: skip


def _line(relation: Relation) -> str:
    return f"line {relation.source.span.line}"


def translate(
    name: str,
    *,
    search_path: list[str] | None = None,
    modifications: Modifications | None = None,
    units: str = "error",
    access: Access = NONE,
) -> tuple[Prepared, Report]:
    """All passes up to, not including, C: for `--dump` and for tests. `units`: see `flatten`."""
    report = Report()
    with not_too_deep(name):
        library = report.run("library", Library, search_path, access)
        model = report.run("flatten", flatten, library, name, dict(modifications or {}), units)
        return prepare(model, report), report


@contextmanager
def not_too_deep(name: str) -> Iterator[None]:
    """Raises P013 where the expressions of the model `name` are nested beyond what Python follows."""
    try:
        yield
    except RecursionError:
        hint = "give parts of it names of their own; a loop of a function that is unrolled nests as often as it runs"
        raise Diagnostic("P013", f"{name} has an expression that is nested too deeply", None, hint) from None


def compile_model(
    name: str,
    *,
    search_path: list[str] | None = None,
    cache_directory: str | None = None,
    modifications: Modifications | None = None,
    units: str = "error",
    sensitivities: bool = False,
    access: Access = NONE,
    quick: bool = False,
) -> CompiledModel:
    """Translate and compile a model, or take it from the cache where nothing that it was made from has changed.

    `units`: see `flatten`. `sensitivities`: with the derivatives that a run with sensitivities needs (its C is twice as
    long, and a model of its own in the cache).
    `access`: what a model may reach beyond its text. `quick`: in half the time, where a model is one of hundreds that
    are looked at (its C is optimised less, its results are the same). Raises Diagnostic (a finding about the model) or
    cache.CompilerError (the C compiler failed).
    """
    store = cache.Cache(cache_directory)
    request = cache.request_key(name, search_path, modifications, units, sensitivities, access, quick)
    found = store.find(request)
    if found:
        return CompiledModel(found.name, found.library, found.hash, Report(cached=True, warnings=found.warnings))
    with _translating, own_table(), _uncollected():
        prepared, report = translate(
            name, search_path=search_path, modifications=modifications, units=units, access=access
        )
        prepared.hash = cache.content_hash(prepared.declared, modifications, units, sensitivities)
        source = report.run("C", generate, prepared, sensitivities)
    library = report.run("compile", store.build, prepared.hash, source, prepared.declared.foreign, quick)
    store.remember(request, prepared, library, report.warnings, search_path)
    return CompiledModel(prepared.declared.name, library, prepared.hash, report)
