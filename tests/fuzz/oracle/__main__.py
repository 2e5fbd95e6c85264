"""python -m tests.fuzz.oracle [--seconds 180] [--seed 1]: random models against the oracle.

Each round is a model of 24 probes and four event machines. Prints how many of each were tried and what was found; each
finding is kept as a file below out/fuzz/oracle. The exit status is 1 where a value was wrong or something crashed.
"""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
import random
import sys
import tempfile
import time

from tests.fuzz.oracle.judge import SOLVERS, Finding, draw_probes, try_machine, try_probes
from tests.fuzz.oracle.play import draw_machine

PROBES, MACHINES = 24, 4


def round_of(seed: int, folder: Path) -> tuple[Counter[str], list[Finding]]:
    """What was tried, and what was found."""
    dice, solver = random.Random(seed), SOLVERS[seed % len(SOLVERS)]
    probes = draw_probes(dice, PROBES)
    found = try_probes(probes, folder, solver)
    for k in range(MACHINES):
        found += try_machine(*draw_machine(dice), folder, SOLVERS[(seed + k) % len(SOLVERS)])
    return Counter(p.place for p in probes) + Counter({"machine": MACHINES}), found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10**9, help="rounds at most")
    options = parser.parse_args()
    kept = Path("out/fuzz/oracle")
    kept.mkdir(parents=True, exist_ok=True)
    tried, found, seed = Counter[str](), Counter[str](), options.seed
    end = time.monotonic() + options.seconds
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() < end and seed < options.seed + options.count:
            places, findings = round_of(seed, Path(folder))
            tried += places
            for k, finding in enumerate(findings):
                found[f"{finding.what} ({finding.place})"] += 1
                (kept / f"{seed}_{k}.mo").write_text(f"/* {finding.what}: {finding.detail} */\n{finding.model}")
                said = f"seed {seed}: {finding.what} ({finding.place}): {finding.detail[:300]}"
                print(said, file=sys.stderr, flush=True)
            seed += 1
    places = ", ".join(f"{n} {place}" for place, n in tried.most_common())
    print(f"{seed - options.seed} rounds, {tried.total()} tries: {places}")
    print("found: " + (", ".join(f"{n} {what}" for what, n in found.most_common()) or "nothing"))
    return 1 if any(what.startswith(("wrong", "crashed")) for what in found) else 0


if __name__ == "__main__":
    sys.exit(main())
