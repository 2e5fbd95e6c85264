"""Places that are alike: elements of an array, instances of one class. What is missing at one may be missing at all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import re

from lacuna.discovery.efforts.places.sites import Site

Families = list[tuple[Site, tuple[int, ...]]]  # one place that is all of a family, the numbers of these

_INDEX = re.compile(r"\[[^\]]*\]")


def families(sites: Sequence[Site], acting: Iterable[int]) -> Families:
    """Those of places that are `acting` and differ by an index or an instance."""
    of: dict[tuple, dict[str, int]] = {}
    for k in acting:
        for key, member in _memberships(sites[k]):
            of.setdefault(key, {}).setdefault(member, k)
    return [
        (_every([sites[k] for k in found.values()], tuple(found)), tuple(found.values()))
        for found in of.values() if len(found) > 1
    ]  # fmt: skip


def _every(parts: list[Site], members: tuple[str, ...]) -> Site:
    return Site("every", _label(members), parts=tuple(parts), members=members, term=_whole([p.term for p in parts]))


def _whole(terms: list[str]) -> str:
    """What is added to all equations of an array or a loop, with @ for an array of what they lack; @ where each has a
    text of its own."""
    loop = re.fullmatch(r"\(if (\w+) == 1 then @ else 0\)", terms[0])
    if loop and all(t == f"(if {loop[1]} == {k} then @ else 0)" for k, t in enumerate(terms, 1)):
        return f"@[{loop[1]}]"
    rows = ("{" + ", ".join("@" if n == k else "0" for n in range(len(terms))) + "}" for k in range(len(terms)))
    return "{@}" if all(map(str.__eq__, terms, rows)) else "@"


def _memberships(site: Site) -> list[tuple[tuple, str]]:
    """(family, member) of a site: of equations by what they say, of components by where they stand."""
    if site.kind == "equation":
        named = site.left if site.term != "@" else site.instance
        key = ("equation", site.span)
    elif site.kind in ("node", "branch"):
        named = site.left if site.kind == "node" else site.label
        key = (site.kind, site.port.flow, site.cls)
    else:
        return []
    found = []
    indices = _INDEX.findall(named)
    if len(indices) == 1:
        found.append(((*key, _INDEX.sub("[:]", named)), named))
    elif site.kind == "equation" and site.instance and not indices and site.term == "@":
        found.append(((*key, tuple(step.cls.path for step in site.way)), site.instance))
    elif site.cls and not indices:
        found.append((key, named))
    return found


def is_array(members: Sequence[str]) -> bool:
    return all(_INDEX.search(m) for m in members)


def _label(members: tuple[str, ...]) -> str:
    if is_array(members):
        return re.sub(r"^der\((.*)\)$", r"\1", _INDEX.sub("[:]", members[0]))
    return ", ".join(members)


def meant(name: str, here: str, there: str) -> str:
    """What a name that is said of one member of a family is of another one: by its index, or by its instance."""
    index, other = _INDEX.search(here), _INDEX.search(there)
    if index and other:
        return name.replace(index[0], other[0])
    return re.sub(rf"(?<![\w.\]]){re.escape(here)}\.", f"{there}.", name)


def said_of_all(text: str, members: Sequence[str]) -> str:
    """A text about the first member with `:` for its index."""
    index = _INDEX.search(members[0]) if members else None
    return text.replace(index[0], "[:]") if index else text


def is_shared(name: str, here: str) -> bool:
    """Whether a name can be said of every member: it has no index but the member's own."""
    index = _INDEX.search(here)
    return all(index is not None and found == index[0] for found in _INDEX.findall(name))
