"""python -m tests.mutation FILE ... --tests PATH ... [--only N] [--build]: does a test fail for each small fault?

Each mutant is put into this checkout, which has to be clean, and taken back. Prints those that survive, a line each,
and how many were killed; `--only` takes that many of them, drawn with a fixed seed. C needs `--build`.
"""

from __future__ import annotations

import argparse
from pathlib import Path
import random
import subprocess
import sys
import time

from tests.mutation.mutants import Mutant, mutants

ROOT = Path(__file__).parents[2]
PATIENCE = 5.0  # times the untouched tests' seconds: a mutant that takes longer hangs


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--tests", nargs="+", required=True)
    parser.add_argument("--only", type=int, default=0)
    parser.add_argument("--build", action="store_true")
    options = parser.parse_args()
    if subprocess.run(["git", "diff", "--quiet", "--", *options.files], cwd=ROOT, check=False).returncode:
        parser.error("these files have changes that are not committed")
    found = [mutant for path in options.files for mutant in mutants(path)]
    drawn = random.Random(1).sample(found, options.only) if 0 < options.only < len(found) else found
    begun = time.monotonic()
    if _said(options.tests, options.build, None) != "survived":
        parser.error("the tests fail without a mutant")
    patience = PATIENCE * (time.monotonic() - begun)
    counts = dict.fromkeys(("killed", "survived", "stillborn", "hung"), 0)
    for mutant in drawn:
        said = _tried(mutant, options.tests, options.build, patience)
        counts[said] += 1
        if said == "survived":
            print(mutant.told(mutant.path.read_text(encoding="utf-8")), flush=True)
    print(f"{len(drawn)} of {len(found)}: {', '.join(f'{n} {what}' for what, n in counts.items())}")
    return 0


def _tried(mutant: Mutant, tests: list[str], build: bool, patience: float) -> str:
    source = mutant.path.read_text(encoding="utf-8")
    try:
        mutant.path.write_text(mutant.applied(source), encoding="utf-8")
        return _said(tests, build, patience)
    finally:
        mutant.path.write_text(source, encoding="utf-8")


def _said(tests: list[str], build: bool, patience: float | None) -> str:
    if build and subprocess.run(["ninja", "-C", "build"], cwd=ROOT, capture_output=True, check=False).returncode:
        return "stillborn"
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, timeout=patience, check=False)
    except subprocess.TimeoutExpired:
        return "hung"
    return "killed" if done.returncode else "survived"


if __name__ == "__main__":
    sys.exit(main())
