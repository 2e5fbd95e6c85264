"""Which sites of a model an input can act at: where it would not have to be differentiated, and is a model still."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.cache import CompilerError
from lacuna.codegen.compile import translate
from lacuna.codegen.errors import Diagnostic
from lacuna.discovery.case.case_model import UNITS
from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.searched import write_source
from lacuna.discovery.efforts.places.insertion import effort_at, probe
from lacuna.discovery.efforts.places.sites import Site
from lacuna.discovery.fit.solver.time_limit import check

RIGID = "what acts there would have to be differentiated: states depend on each other by it"


def openable(case: Case, amendment: Amendment, sites: list[Site], closed: list[tuple[str, str]]) -> list[Site]:
    """Sites where an input can act, tried together, without those that a refusal names, and, where it names none and
    that is no model, in halves; the others are `closed`."""
    check()
    try:
        translate(str(write_source(with_probes(amendment, sites))), search_path=case.search_path, units=UNITS)
    except (Diagnostic, CompilerError) as reason:
        rigid = _named_in(reason, len(sites))
        closed += [(sites[k].label, RIGID) for k in sorted(rigid)]
        left = [s for k, s in enumerate(sites) if k not in rigid]
        if rigid:
            return openable(case, amendment, left, closed) if left else []
        if len(sites) == 1:
            closed.append((sites[0].label, str(reason).split(": error", 1)[-1].split("\n")[0]))
            return []
        halves = (sites[: len(sites) // 2], sites[len(sites) // 2 :])
        return [site for half in halves for site in openable(case, amendment, half, closed)]
    return sites


def _named_in(reason: Diagnostic | CompilerError, count: int) -> set[int]:
    """Numbers of the sites of `count` whose inputs would have to be differentiated."""
    if not isinstance(reason, Diagnostic) or reason.code != "S004":
        return set()
    return {k for k in range(count) if effort_at(k) in reason.about}


def with_probes(amendment: Amendment, sites: list[Site]) -> Amendment:
    probes, inputs = zip(*(probe(site, k) for k, site in enumerate(sites)), strict=True) if sites else ((), ())
    return replace(amendment, attachments=[*amendment.attachments, *probes], inputs=tuple(inputs))
