"""Commands that write, with some of their writes failing; all of them: python -m tests.faults --slow."""

from __future__ import annotations

from pathlib import Path
import re
import subprocess

import pytest

from tests.faults.preload import with_shim

# name: how many calls there are at least, so that a trap that catches nothing is seen; every how many-th one fails
QUICK = {"simulate": (20, 4), "examples": (500, 97)}


@pytest.mark.parametrize("name", QUICK)
def test_no_write_that_fails_leaves_half_a_result(name: str, tmp_path: Path) -> None:
    least, every = QUICK[name]
    done = with_shim(tmp_path, [name, "--every", str(every)], subprocess.PIPE)
    assert done.returncode == 0, done.stdout
    calls, failed, fell = map(int, re.findall(r"\d+", done.stdout.splitlines()[-1].split(":")[1]))
    assert (calls >= least, failed >= calls // every, fell) == (True, True, 0)
