"""trace.json: every hypothesis that was looked at is told or has left for a reason."""

from __future__ import annotations

import json
from pathlib import Path

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.catalogue.trace import Trace, left, looking, traced
from lacuna.discovery.explain import explain
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.law.empirical_law import unfitted
from lacuna.discovery.law.law import Law
from lacuna.discovery.law.law_screen import sites
from lacuna.discovery.law.terms.law_terms import Group

from .conftest import BELIEVED, conceal


def test_every_hypothesis_is_told_or_has_left_for_a_reason(tmp_path: Path) -> None:
    case = load(conceal(tmp_path / "case", BELIEVED, drag="QuadraticDrag(c2=7e-8)"))
    found = explain(case)
    every = enumerate_attachments(case, read(Library(), case.model), catalogue.read(Library()), found.amendment)
    labels = {e.hypothesis for e in found.trace.entries if e.looking == "missing physics, round 1"}
    told = {f.ranked.attachment.label for f in found.findings}
    assert told and not told & labels and {a.label for a in every} <= labels | told
    assert all(e.why for e in found.trace.entries)
    kept = json.loads(found.trace.write(tmp_path).read_text())["left"]
    assert [e["hypothesis"] for e in kept] == [e.hypothesis for e in found.trace.entries]


def test_a_law_of_which_there_is_no_model_leaves_with_what_is_wrong_with_it(tmp_path: Path) -> None:
    case = load(conceal(tmp_path / "case", BELIEVED, drag="QuadraticDrag(c2=7e-8)"))
    base, _ = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))
    law = Law(sites(case, base)[0], (Group(("+ -nobody",)),))
    with traced() as trace:
        assert unfitted(case, base.machine.amendment, base, law, {"c_1": 1.0}, None) is None
    (entry,) = trace.entries
    assert entry.step == "model" and "nobody" in entry.hypothesis and "error[" in entry.why


def test_nothing_is_kept_outside_and_numbers_only_where_there_are_some(tmp_path: Path) -> None:
    left("friction", "screen", "nobody listens")
    with traced() as trace:
        looking("a law at a")
        left("friction", "screen", "less", promise=0.123456)
    left("friction", "screen", "nobody listens any more")
    entry = {"looking": "a law at a", "hypothesis": "friction", "step": "screen", "why": "less", "promise": 0.1235}
    assert json.loads(trace.write(tmp_path).read_text()) == {"left": [entry]}
    assert json.loads(Trace().write(tmp_path).read_text()) == {"left": []}
