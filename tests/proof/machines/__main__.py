"""The proof on machines of others: `python -m tests.proof.machines [--seed 101] [--small | --report] [--jobs 1]`.

Resumes; every run is kept in runs.csv, and docs/proof-machines.md is written from all of them. The table of each of its
cases is beside these, in OUT/seed.../VERSION.md.
"""

from __future__ import annotations

import argparse
from pathlib import Path
import sys
import time

from tests.proof.machines.generate import generate
from tests.proof.machines.page import counted, keep, page
from tests.proof.machines.plan import plan, small
from tests.proof.machines.score import by_style, listing, score_folder, table
from tests.proof.runner import ROOT, content_hash, diagnose, finished, run_all, tool_hash

EXPLAIN = (sys.executable, "-m", "lacuna.cli.main", "explain", "--limit", "400")
SCORED = ("__main__.py", "page.py", "score.py", "test_machines.py")  # what no case is drawn by
LIMIT = 600.0  # seconds of wall clock for a case, on a machine that others use too


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "prove-machines")
    parser.add_argument("--seed", type=int, default=101)
    parser.add_argument("--small", action="store_true", help="two cases of every machine, and of strangers the pairs")
    parser.add_argument("--prepare", action="store_true", help="only the cases")
    parser.add_argument("--report", action="store_true", help="score and write up what is finished by this version")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=float("inf"), help="after which no further case is begun")
    return parser.parse_args()


def main() -> int:
    arguments = _arguments()
    cases = plan(arguments.seed)
    cases = small(cases) if arguments.small else cases
    here = Path(__file__).parent
    drawn_by = [f for f in here.rglob("*.py") if f.name not in SCORED]
    out = arguments.out / f"seed{arguments.seed}-{content_hash(sorted(drawn_by))[:6]}"
    version, end = tool_hash(), time.monotonic() + 60 * arguments.minutes

    def work(name: str) -> str:
        if time.monotonic() > end:
            return "left for the next call"
        if not (out / "truth" / f"{name}.toml").exists():
            try:
                generate(next(c for c in cases if c[0] == name), out)
            except ValueError as reason:
                return f"cannot be drawn: {reason}"
        if arguments.prepare:
            return "prepared"
        if tool_hash() != version:
            raise SystemExit("the tool has been edited since the run began: start it again")
        return diagnose(EXPLAIN, out / "cases" / name, out / version / name, version, LIMIT)

    if not arguments.report:
        run_all([c[0] for c in cases], work, arguments.jobs)
    if arguments.prepare:
        return 0
    names = [c[0] for c in cases if finished(out / version / c[0], version)]
    scores = score_folder(out / version, out / "truth", names)
    text = f"Seed {arguments.seed}, {len(scores)} of {len(plan(arguments.seed))} cases, tool `{version}`.\n\n"
    text += f"{table(scores)}\n"
    text += f"By how the model is written: {by_style(scores)}.\n\n{listing(scores)}"
    (out / f"{version}.md").write_text(text)
    print(text)
    if scores:
        every = keep(counted(arguments.seed, version, arguments.small, len(cases), scores))
        target = ROOT / "docs" / "proof-machines.md"
        target.write_text(page(every, arguments.seed, version, scores))
        print(f"written: {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
