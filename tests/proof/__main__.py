"""The proof: `python -m tests.proof --out DIR [--seed 4] [--quick]`; resumes, and writes docs/proof.md when whole."""

import argparse
from concurrent.futures import ProcessPoolExecutor, as_completed
import os
from pathlib import Path
import shutil
import sys

from tests.proof.generate import generate
from tests.proof.plan import plan, quick, spread
from tests.proof.report import page, summary_table
from tests.proof.runner import ROOT, diagnose, finished, generator_hash, run_all, tool_hash, usual_hash
from tests.proof.score import score_folder

USUAL = (sys.executable, "-m", "tests.proof.baseline")
EXPLAIN = (sys.executable, "-m", "cli.main", "explain")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "prove")
    parser.add_argument("--seed", type=int, default=4)
    parser.add_argument("--quick", action="store_true", help="one case of each kind, and no page")
    parser.add_argument("--prepare", action="store_true", help="only the cases, and the usual alternative on them")
    parser.add_argument("--report", action="store_true", help="diagnose nothing: score and write up what is finished")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases side by side")
    parser.add_argument("--timeout", type=float, default=300.0, help="seconds for a case")
    return parser.parse_args()


def _generate(cases: list, out: Path, jobs: int) -> None:
    """Writes the cases that are not there yet; those of another version of the generator go."""
    stamp, version = out / "generator", generator_hash()
    if not (stamp.exists() and stamp.read_text() == version):
        for kind in ("cases", "truth"):
            shutil.rmtree(out / kind, ignore_errors=True)
        out.mkdir(parents=True, exist_ok=True)
        stamp.write_text(version)
    missing = [(n, p, s, out) for n, p, s in cases if not (out / "truth" / f"{n}.toml").exists()]
    with ProcessPoolExecutor(jobs) as pool:
        for k, done in enumerate(as_completed([pool.submit(generate, case) for case in missing]), start=1):
            done.result()
            print(f"cases [{k}/{len(missing)}]", flush=True)


def _diagnose(names: list[str], out: Path, arguments: argparse.Namespace) -> None:
    """The usual alternative on every case, then the tool; an edit of the tool while it runs ends the run."""
    usual, version = usual_hash(), tool_hash()

    def alternative(name: str) -> str:
        return diagnose(USUAL, out / "cases" / name, out / "usual" / name, usual, arguments.timeout)

    def tool(name: str) -> str:
        if tool_hash() != version:
            raise SystemExit("the tool has been edited since the run began: start it again")
        return diagnose(EXPLAIN, out / "cases" / name, out / "lacuna" / name, version, arguments.timeout)

    run_all(names, alternative, arguments.jobs, "usual alternative")
    if not arguments.prepare:
        run_all(names, tool, arguments.jobs, "lacuna")


def main() -> int:
    arguments = _arguments()
    every = spread(plan(arguments.seed))
    cases = quick(every) if arguments.quick else every
    names = [name for name, _, _ in cases]
    out = arguments.out / f"seed{arguments.seed}"
    if not arguments.report:
        _generate(cases, out, arguments.jobs)
        _diagnose(names, out, arguments)
    if arguments.prepare:
        return 0
    versions = {"lacuna": tool_hash(), "usual": usual_hash()}
    names = sorted(n for n in names if all(finished(out / k / n, v) for k, v in versions.items()))
    if not names:
        raise SystemExit("nothing is finished by this version of the tool")
    scores, alternative = (score_folder(out / k, out / "truth", names) for k in versions)
    print(summary_table(scores, alternative))
    text = page(scores, alternative, arguments.seed, len(every))
    target = arguments.out / "proof.md" if arguments.quick else ROOT / "docs" / "proof.md"
    target.write_text(text)
    print(f"written: {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
