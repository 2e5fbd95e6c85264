"""The Modelica Association's compliance library: every case but those listed comes out as it should."""

from __future__ import annotations

from pathlib import Path

import pytest

from bench import compliance, isolated
from lacuna.codegen import cache


@pytest.fixture(scope="module")
def outcomes(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, bool], compliance.Outcomes]:
    """What should become of every case, and what did: the whole library, half a minute on two cores."""
    folder = shared / "compliance"
    if not folder.is_dir():
        pytest.skip(f"needs the compliance library of the Modelica Association; not at {folder}")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cache, "COMPILER", tuple(o for o in cache.COMPILER if o != "-O2"))
        verdicts = compliance.cases(folder)
        return verdicts, isolated.run_all(
            verdicts, lambda name: compliance.judge(name, folder), tmp_path_factory.mktemp("compliance"),
            timeout=compliance.TIMEOUT, progress=False,
        )  # fmt: skip


@pytest.mark.xdist_group("compliance")
@pytest.mark.timeout(900)  # a thousand cases count in the first test's time
def test_what_goes_wrong_is_what_is_listed(outcomes: tuple[dict[str, bool], compliance.Outcomes]) -> None:
    verdicts, results = outcomes
    assert len(verdicts) > 1000
    wrong = compliance.wrong(verdicts, results)
    listed = {name for names in compliance.left().values() for name in names}
    lost = {name: results[f"{compliance.PREFIX}{name}"] for name in wrong if name not in listed}
    assert lost == {}, "met before, no longer met"
    assert listed - set(wrong) == set(), "met now: strike it from bench/compliance_left.toml"


@pytest.mark.xdist_group("compliance")
def test_nothing_crashes(outcomes: tuple[dict[str, bool], compliance.Outcomes]) -> None:
    _, results = outcomes
    assert [name for name, r in results.items() if r["status"] in ("crash", "timeout")] == []


def test_every_case_listed_has_a_reason_and_stands_on_the_page() -> None:
    page = (compliance.ROOT / "docs" / "compliance.md").read_text(encoding="utf-8")
    for names in compliance.left().values():
        for name, reason in names.items():
            assert reason, name
            assert f"- {name}: {reason}" in page, f"{name}: write the page anew by `make compliance`"


def test_a_case_that_is_no_longer_met_is_named() -> None:
    verdicts = {f"{compliance.PREFIX}A.Good": True, f"{compliance.PREFIX}A.Bad": False}
    good = {f"{compliance.PREFIX}A.Good": {"status": "passed"}, f"{compliance.PREFIX}A.Bad": {"status": "refused"}}
    assert compliance.wrong(verdicts, good) == []
    swapped = {f"{compliance.PREFIX}A.Good": {"status": "crash"}, f"{compliance.PREFIX}A.Bad": {"status": "passed"}}
    assert compliance.wrong(verdicts, swapped) == ["A.Good", "A.Bad"]
