"""python -m tests.fuzz --seconds 600 [--seed 1]: systems one after the other; failures are kept as files."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
import sys
import tempfile
import time
import traceback

from tests.fuzz.models import random_system
from tests.fuzz.systems import try_system


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    outcomes, seed, end = Counter[str](), options.seed, time.monotonic() + options.seconds
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() < end:
            try:
                outcomes[try_system(seed, Path(folder))] += 1
            except Exception as error:
                outcomes["FAILED"] += 1
                report = f"seed {seed}: {type(error).__name__}: {error}\n{traceback.format_exc(limit=-4)}"
                Path(f"fuzz_system_{seed}.txt").write_text(f"{report}\n{random_system(seed)}")
                print(report[:600], file=sys.stderr, flush=True)
            seed += 1
    print(f"{outcomes.total()} systems: " + ", ".join(f"{n} {what}" for what, n in outcomes.most_common()))
    return 1 if outcomes["FAILED"] else 0


if __name__ == "__main__":
    sys.exit(main())
