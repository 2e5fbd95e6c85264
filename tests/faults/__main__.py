"""python -m tests.faults [NAME ...] [--every N] [--slow]: every write of these commands fails once; see `trial`.

Prints one line a command: how many calls there are that change something, how many were made to fail, and what fell.
Started without the shim it starts itself with it.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
import sys
import tempfile

from tests.faults.preload import with_shim
from tests.faults.scenarios import SCENARIOS


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--every", type=int, default=1, help="only each N-th call")
    parser.add_argument("--slow", action="store_true", help="commands that take seconds, too")
    options = parser.parse_args()
    names = options.names or [n for n, s in SCENARIOS.items() if options.slow or not s.slow]
    with tempfile.TemporaryDirectory() as folder:
        if "shim" not in os.environ.get("LD_PRELOAD", ""):
            return with_shim(Path(folder), [*names, "--every", str(options.every)]).returncode
        from tests.faults.trial import Trial, imported

        imported()
        fell = 0
        for name in names:
            trial = Trial(name, SCENARIOS[name], Path(folder).resolve() / name)
            fell += trial.run(options.every)
        return 1 if fell else 0


if __name__ == "__main__":
    sys.exit(main())
