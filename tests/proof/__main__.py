"""The proof: `python -m tests.proof --out DIR [--seed 19] [--quick]`; resumes, and writes docs/proof.md when whole."""

import argparse
from concurrent.futures import ProcessPoolExecutor
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
EXPLAIN = (
    sys.executable,
    "-m",
    "lacuna.cli.main",
    "explain",
    "--limit",
    "250",
)  # the rest of a case's time is for its end


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "prove")
    parser.add_argument("--seed", type=int, default=19)
    parser.add_argument("--quick", action="store_true", help="one case of each kind, and no page")
    parser.add_argument("--prepare", action="store_true", help="only the cases, and the usual alternative on them")
    parser.add_argument("--report", action="store_true", help="diagnose nothing: score and write up what is finished")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases side by side")
    parser.add_argument("--timeout", type=float, default=300.0, help="seconds for a case")
    return parser.parse_args()


def _fresh(out: Path) -> None:
    """Makes room for the cases; those of another version of the generator go."""
    stamp, version = out / "generator", generator_hash()
    if not (stamp.exists() and stamp.read_text() == version):
        for kind in ("cases", "truth"):
            shutil.rmtree(out / kind, ignore_errors=True)
        out.mkdir(parents=True, exist_ok=True)
        stamp.write_text(version)


def _run(cases: list, out: Path, arguments: argparse.Namespace) -> None:
    """Every case: generated, diagnosed by the usual alternative and by the tool. An edit of the tool ends the run."""
    usual, version = usual_hash(), tool_hash()
    planned = {item[0]: (*item, out) for item in cases}

    def diagnosed(command: tuple[str, ...], kind: str, name: str, key: str) -> str:
        return diagnose(command, out / "cases" / name, out / kind / name, key, arguments.timeout)

    def work(name: str) -> str:
        if not (out / "truth" / f"{name}.toml").exists():
            generators.submit(generate, planned[name]).result()
        status = diagnosed(USUAL, "usual", name, usual)
        if arguments.prepare:
            return status
        if tool_hash() != version:
            raise SystemExit("the tool has been edited since the run began: start it again")
        return diagnosed(EXPLAIN, "lacuna", name, version)

    _fresh(out)
    with ProcessPoolExecutor(arguments.jobs) as generators:
        run_all(list(planned), work, arguments.jobs)


def main() -> int:
    arguments = _arguments()
    every = spread(plan(arguments.seed))
    cases = quick(every) if arguments.quick else every
    out = arguments.out / f"seed{arguments.seed}"
    if not arguments.report:
        _run(cases, out, arguments)
    if arguments.prepare:
        return 0
    versions = {"lacuna": tool_hash(), "usual": usual_hash()}
    names = sorted(n for n, _, _ in cases if all(finished(out / k / n, v) for k, v in versions.items()))
    if not names:
        raise SystemExit("nothing is finished by this version of the tool")
    scores, alternative = (score_folder(out / k, out / "truth", names) for k in versions)
    print(summary_table(scores, alternative))
    text = page(scores, alternative, arguments.seed, len(every), versions["lacuna"])
    target = arguments.out / "proof.md" if arguments.quick else ROOT / "docs" / "proof.md"
    target.write_text(text)
    print(f"written: {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
