"""Places of any model where an effort may be missing, read from the class itself.

A *node* is a set of connected ports: something may flow in. An *edge* is a connection: something may be lost across it.
A *branch* goes past a component of two ports: something may flow beside it. An *equation* written in the class is a
balance: a term may be missing. A *signal* goes from one component into another: it may arrive otherwise than it was
sent. An *exchange* joins two such balances: what one of them gains the other one loses. A *parameter* may vary, in all
equations in which it stands at once (what makes a force of a motor's current and a voltage of its speed), and an
*input* may act otherwise than it was commanded, wherever it is read. Ports are any connectors of one flow and one
potential; which is which the declaration says. Nothing is known here of domains, classes or names.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path
import re

from lacuna.codegen.errors import Span
from lacuna.codegen.syntax import ast

SEVERAL = ("exchange", "parameter", "input")  # kinds of places that may be in several balances at once
MOST = 12  # places of one array, balances of one unit, variables at a place: what a search costs is their pairs


@dataclass(frozen=True)
class Port:
    """A connector class of one flow and one potential, by the names of its variables."""

    path: str
    flow: str
    potential: str


@dataclass(frozen=True)
class Step:
    """From a class to one that it is made of, which it names at `span`: a base, or the class of a `component`, of an
    array of these that of one `element`; of one further inside, where its modification redeclares that."""

    cls: ast.Class
    span: Span
    component: str = ""
    element: tuple[int, ...] = ()
    shape: tuple[int, ...] = ()


@dataclass(frozen=True)
class Site:
    """A place. `ends` are those of its connection, both of its component, or all of a node's, of which one suffices;
    of a signal, the second one is what it goes `into`, or the first. `span` is where its equation or connection stands,
    in the class, or in another one on the `way` from there, which ends in the component `instance` if it goes into any;
    `parts` are the two equations of an exchange, those in which a parameter or an input stands, and of `every` place of
    a family all, in which the same law holds; its `members` are told apart by their names. Of an array of
    equations, or one in a loop, it is one: `term` is what is added to all, with @ for what this one lacks, `left` the
    variable or rate on its left side; of a node, a component that has all its ports there."""

    kind: str  # node | edge | branch | signal | equation | exchange | parameter | input | every
    label: str
    ends: tuple[str, ...] = ()
    port: Port | None = None
    span: Span | None = None
    instance: str = ""
    into: str = ""
    parts: tuple[Site, ...] = ()
    term: str = "@"
    left: str = ""
    way: tuple[Step, ...] = ()
    members: tuple[str, ...] = ()

    @property
    def together(self) -> Site | None:
        """Of every equation of an array or a loop of the class itself: the one in which what all of them lack is added
        as an array."""
        if not self.members or self.term == "@" or self.parts[0].way:
            return None
        return replace(self.parts[0], term=self.term, members=self.members)

    @property
    def stands(self) -> str:
        """What tells it from others of its name: what flows together, its equation or connection with the line."""
        if self.kind == "node":
            return f"into {', '.join(self.ends)}"
        if self.kind == "branch":
            return f"past {self.label}"
        where = self.span or (self.parts[0].span if self.parts else None)
        return f"{self.label} ({Path(where.file).name}:{where.line})" if where else self.label

    @property
    def sign(self) -> str:
        """Of a term on the right side by which the storage grows: minus where the rate stands there, too."""
        left, _, right = self.label.partition("=")
        return "-" if "der(" in right and "der(" not in left else ""

    @property
    def outside(self) -> bool:
        """Whether what acts there is connected from outside the components; else it is a term that one of their classes
        takes in."""
        return self.port is not None and not self.instance

    def acting(self, effort: str) -> tuple[str, list[str]]:
        """(declaration of the ports, equations) of what lets an effort flow into a node, lets it flow past a component
        from its first port to the second, or loses it in a connection."""
        flow, potential = self.port.flow, self.port.potential
        if self.kind == "node":
            return f"{self.port.path} port;", [f"port.{flow} = -({effort});"]
        does = f"b.{flow} = -({effort})" if self.kind == "branch" else f"a.{potential} - b.{potential} = {effort}"
        return f"{self.port.path} a, b;", [f"a.{flow} + b.{flow} = 0;", f"{does};"]

    @property
    def ports(self) -> tuple[str, ...]:
        """Where it is joined, as the class says it in which it stands."""
        return tuple(self.inside(end) for end in self.ends)

    @property
    def element(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """(which element, of how many) of the arrays of components on the way, or of its own."""
        if self.members:
            return (), (len(self.members),)
        steps = [step for step in self.way if step.component]
        return sum((s.element for s in steps), ()), sum((s.shape for s in steps), ())

    @property
    def text(self) -> tuple:
        """What tells its text from others: all elements of an array of components share theirs."""
        way = tuple((step.span, step.component) for step in self.way)
        own = self.local if self.kind == "parameter" else "" if self.instance else self.label
        return self.kind, self.span, self.term, self.ports, way, own

    @property
    def local(self) -> str:
        """The label as its own class says it."""
        instance, _, text = self.label.partition(": ")
        return text if text and instance == self.instance else self.inside(self.label)

    def inside(self, name: str) -> str:
        """What a variable is called in the class in which the place is."""
        return name.removeprefix(f"{self.instance}.") if self.instance else name


@dataclass(frozen=True)
class Sites:
    """The places of a class that are open, and what is not and why; `inside` are equations of components whose classes
    are of a library, open to what varies in several of them."""

    cls: ast.Class
    places: tuple[Site, ...]
    closed: tuple[tuple[str, str], ...]
    inside: tuple[Site, ...] = ()


def exchanges(places: Iterable[Site], unit: Callable[[Site], str]) -> list[Site]:
    """Pairs of balances of one unit that are written in the class: a leak from one volume to another, heat between two
    nodes, a spring between two masses, where no component joins them. None of a unit that more than MOST have."""
    of: dict[str, list[Site]] = {}
    for site in places:
        if site.kind == "equation" and not site.instance and "der(" in site.label:
            of.setdefault(unit(site), []).append(site)
    return [
        Site("exchange", f"{a.label} and {b.label}", parts=(a, b))
        for balances in of.values() if len(balances) <= MOST for a, b in combinations(balances, 2)
    ]  # fmt: skip


def varying(places: Iterable[Site], names: Mapping[str, int], kind: str = "parameter") -> list[Site]:
    """Parameters, or inputs, that stand in equations which are all open; `names` says in how many. What varies in one
    is a term of it, but may be short only as what its parameter is (a rate that too much of a substrate inhibits)."""
    equations = [site for site in places if site.kind == "equation" and site.term == "@"]
    found = []
    for name in names:
        owners = {"", name.rpartition(".")[0]}
        parts = [e for e in equations if e.instance in owners and re.search(_alone(e.inside(name)), e.local)]
        if 1 <= len(parts) == names[name] and len({(e.instance, e.way) for e in parts}) == 1:
            found.append(Site(kind, name, parts=tuple(parts), instance=parts[0].instance, way=parts[0].way))
    return found


def _alone(name: str) -> str:
    """Where a name stands by itself: no part of another one, not called, no name of an argument."""
    return rf"(?<![\w.']){re.escape(name)}(?![\w.'(\[])(?!\s*\()(?!\s*=[^=].*\))"


def occurrences(name: str, text: str, begin: int, end: int) -> list[int]:
    """Where a name stands by itself in text[begin:end]."""
    return [begin + m.start() for m in re.finditer(_alone(name), text[begin:end])]


def renames(site: Site) -> bool:
    """Whether an equation only says that two variables are one."""
    text = site.label.rpartition(" [")[0] if site.term != "@" else site.label
    return site.kind == "equation" and re.fullmatch(r"\s*-?[\w.\[\]]+\s*=\s*-?[\w.\[\]]+\s*", text) is not None


def root(group: dict[str, str], end: str) -> str:
    """Of names that are joined in a group, the one that stands for all."""
    while group.setdefault(end, end) != end:
        end = group[end]
    return end
