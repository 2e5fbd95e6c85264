"""The models that a search tries, as files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
import hashlib
from pathlib import Path

from lacuna.codegen.cache import Cache
from lacuna.codegen.compile import translate
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.classes import Library
from lacuna.codegen.structure.sorting.tearing import Assignment
from lacuna.codegen.symbolic.expr import var
from lacuna.discovery.case.case_model import UNITS
from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import Structure, read
from lacuna.written import write_whole


def write_source(amendment: Amendment) -> Path:
    """The search model as a file in the cache, named by its content, so equal hypotheses share one compiled model."""
    text = amendment.text("Candidate")
    folder = Cache().private() / "candidates"
    name = "Candidate_" + hashlib.sha256(text.encode()).hexdigest()[:16]
    path, named = folder / f"{name}.mo", text.replace("Candidate", name)
    if not path.exists() or path.read_bytes() != named.encode("utf-8"):  # a damaged one would be no hypothesis
        write_whole(path, named, lasting=False)
    return path


def believed_structure(case: Case, library: Library) -> Structure:
    """What is read of a case's model, whose states are those of which the case gives start values."""
    structure = read(library, case.base)
    named = dict.fromkeys(n for start in (case.initial, *(own.initial for own in case.own.values())) for n in start)
    structure.states = _chosen(structure, named, case.search_path) if named else ()
    return structure


def _chosen(structure: Structure, named: Iterable[str], search_path: Sequence[str] | None) -> tuple[str, ...]:
    """Of variables `named` as states those that are none where the model says nothing of it, and can be: the position
    of a mass whose spring prefers its own deflection, or what is none any more where that one is."""
    chosen: tuple[str, ...] = ()
    wanted: tuple[str, ...] = ()
    while True:
        try:
            source = str(write_source(Amendment(replace(structure, states=wanted))))
            believed, _ = translate(source, search_path=search_path, units=UNITS)
        except Diagnostic:
            if not wanted:
                raise
            return chosen
        chosen, known = wanted, _aliases(believed)
        states = {s for s in believed.system.states if not s.startswith("der(")}  # a rate has no start of its own
        variables = (n for n in named if n in believed.declared.variables and n not in wanted)
        none_yet = tuple(n for n in variables if not {n, known.get(n, (n, 1))[0]} & states)
        if not none_yet:
            return chosen
        wanted = (*wanted, *none_yet)


def believed_aliases(amendment: Amendment, search_path: Sequence[str] | None) -> Mapping[str, tuple[str, int]]:
    """(variable, sign) that each name is another one for in the model as believed: what an amended model adds to an
    equation such as T = Th may make two of them. So is a speed that is the rate of an angle which a component measures
    the other way: the state is then that component's."""
    believed, _ = translate(str(write_source(Amendment(amendment.structure))), search_path=search_path, units=UNITS)
    return _aliases(believed)


def _aliases(believed: Prepared) -> Mapping[str, tuple[str, int]]:
    same = {var(n): (n, 1) for n in believed.system.states}
    for step in believed.explicit:
        if isinstance(step, Assignment):
            value, sign = (step.value.args[0], -1) if step.value.op == "neg" else (step.value, 1)
            if value in same:
                name, sense = same[value]
                same[step.unknown] = name, sense * sign
    return {str(n.value): found for n, found in same.items() if n.op == "var"} | believed.aliases
