"""The proof: `python -m tests.proof --out DIR [--seed 2] [--quick]`; resumes, and writes docs/proof.md when whole."""

import argparse
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
import shutil
import sys
import time

from tests.proof import baseline
from tests.proof.generate import generate
from tests.proof.plan import plan, quick
from tests.proof.report import page, summary_table
from tests.proof.runner import ROOT, diagnose, generator_hash, run_all, tool_hash
from tests.proof.score import score_folder


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "prove")
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--quick", action="store_true", help="one case of each kind, and no page")
    parser.add_argument("--report", action="store_true", help="diagnose nothing: score and write up what is finished")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time; a diagnosis uses every core by itself")
    parser.add_argument("--timeout", type=float, default=1800.0, help="seconds for a case")
    parser.add_argument("--command", nargs="+", default=[str(Path(sys.executable).with_name("lacuna")), "explain"])
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
        for k, done in enumerate(as_completed([pool.submit(generate, case) for case in missing])):
            print(f"[{k + 1}/{len(missing)}] {done.result()}", flush=True)


def main() -> int:
    arguments = _arguments()
    every = plan(arguments.seed)
    cases = quick(every) if arguments.quick else every
    names = [name for name, _, _ in cases]
    out = arguments.out / f"seed{arguments.seed}"
    if arguments.report:
        names = [name for name in names if (out / "lacuna" / name / "run.json").exists()]
    else:
        _generate(cases, out, max(arguments.jobs, 2))
    version, started, done = tool_hash(), time.monotonic(), []

    def tool(name: str) -> str:
        return diagnose(arguments.command, out / "cases" / name, out / "lacuna" / name, version, arguments.timeout)

    def usual(name: str) -> str:
        return baseline.diagnose(out / "cases" / name, out / "usual" / name)

    def progress(name: str, status: str) -> None:
        done.append(name)
        print(f"[{len(done)}/{len(names)}] {name} {status}, {time.monotonic() - started:.0f} s", flush=True)

    if not arguments.report:
        run_all(names, tool, arguments.jobs, progress)
    run_all(names, usual, 2, lambda name, status: None)
    scores, alternative = (score_folder(out / k, out / "truth", names) for k in ("lacuna", "usual"))
    print(summary_table(scores, alternative))
    text = page(scores, alternative, arguments.seed, len(every))
    target = arguments.out / "proof.md" if arguments.quick else ROOT / "docs" / "proof.md"
    target.write_text(text)
    print(f"written: {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
