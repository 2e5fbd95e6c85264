"""What there is: models, effects of the catalogue, solvers."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from lacuna.codegen.library.classes import MODEL_KINDS, Library
from lacuna.codegen.library.search_path import search_path
from lacuna.extras import names_missing_packages
from lacuna.runtime import SOLVERS


@dataclass(frozen=True)
class Entry:
    """Something that a command or `load` takes by its name."""

    name: str
    description: str


def list_models(inside: str | Path = "", *, libraries: Iterable[str | Path] = ()) -> list[Entry]:
    """Models that can be simulated, as far as their kind tells: `inside` a package, file or folder (as `load` takes
    it), or else of all libraries given and the package Lacuna. Reads their files; raises Diagnostic on a wrong one."""
    given = list(libraries)
    library = Library(search_path(given))
    if inside:
        roots = [library.find(str(inside))]
    else:  # MODELICAPATH may hold a great deal that nobody asked for
        own = Library([*library.paths[: len(given)], library.paths[-1]])
        roots = [library.find(name) for name in own.members(own.root)]
    classes = [cls for root in roots for cls in (root, *library.all_classes(root))]
    return [Entry(c.path, c.description) for c in classes if c.kind in MODEL_KINDS and not c.partial and not c.alias]


@names_missing_packages
def list_effects(*, libraries: Iterable[str | Path] = ()) -> list[Entry]:
    """The catalogue that an explanation chooses from, identifier and title. Needs the extra `explain`."""
    from lacuna.discovery.catalogue.catalogue import read

    return [Entry(effect.identifier, effect.title) for effect in read(Library(search_path(libraries)))]


def list_solvers() -> list[Entry]:
    """What `simulate(solver=...)` takes."""
    return [Entry(name, SOLVERS_SAID[name]) for name in SOLVERS]


SOLVERS_SAID = {
    "ida": "variable-order BDF on the residual form, analytic Jacobian: the reference, stiff or not",
    "dopri5": "Dormand-Prince 5(4), dense output: fast where nothing is stiff",
    "rodas4": "Rosenbrock method of order 4: stiff contacts, short intervals between events",
    "rk4": "Runge-Kutta of order 4 at a fixed step",
    "euler": "explicit Euler at a fixed step",
}
