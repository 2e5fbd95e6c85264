"""The proof in small, whole: generate, diagnose by the command line, score, print."""

from tests.proof.__main__ import EXPLAIN, USUAL
from tests.proof.generate import generate
from tests.proof.plan import Plan
from tests.proof.report import page, summary_table
from tests.proof.runner import diagnose, tool_hash, usual_hash
from tests.proof.score import score_folder

CASES = (
    ("q1", Plan("effect", "Joint", ("friction.coulomb",), gain=(3.0, 5.0)), 21),
    ("q2", Plan("consistent", "Joint"), 22),
)


def test_a_small_proof(tmp_path):
    for item in CASES:
        generate((*item, tmp_path))
        name = item[0]
        assert diagnose(EXPLAIN, tmp_path / "cases" / name, tmp_path / "lacuna" / name, tool_hash(), 250) == "ok"
        usual = tmp_path / "usual" / name
        assert diagnose(USUAL, tmp_path / "cases" / name, usual, usual_hash(), 100) == "ok"
    names = [name for name, _, _ in CASES]
    tool, usual = (score_folder(tmp_path / k, tmp_path / "truth", names) for k in ("lacuna", "usual"))
    assert all(s.verdict_right for s in tool)
    assert tool[0].first_right
    assert not tool[1].false_finding
    assert "100%" in summary_table(tool, usual)
    assert "## What went wrong" in page(tool, usual, 21, len(CASES), "")
