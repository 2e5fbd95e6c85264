"""No compiler goes on where the process that started it is gone."""

from __future__ import annotations

import os
from pathlib import Path
import subprocess
import sys
import time

import pytest

from lacuna.children import run


def is_alive(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def test_output_and_status_are_the_programs() -> None:
    done = run(["sh", "-c", "echo out; echo error >&2; exit 3"])
    assert (done.returncode, done.stdout, done.stderr) == (3, "out\n", "error\n")


def test_a_missing_program_is_named() -> None:
    with pytest.raises(FileNotFoundError, match="no-such-program"):
        run(["no-such-program"])


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for processes in /proc")
def test_a_killed_parent_takes_its_grandchildren_along(tmp_path: Path) -> None:
    (tmp_path / "cc").write_text("#!/bin/sh\nsleep 100 &\necho $! > child\nwait\n")
    (tmp_path / "cc").chmod(0o755)
    code = "from lacuna.children import run; run(['cc'])"
    paths = os.pathsep.join([str(tmp_path), os.environ["PATH"]])
    parent = subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path, env=os.environ | {"PATH": paths})
    child = tmp_path / "child"
    while not child.exists() or not child.read_text().strip():
        time.sleep(0.02)
    pid = int(child.read_text())
    assert is_alive(pid)
    parent.kill()
    parent.wait()
    end = time.monotonic() + 10
    while is_alive(pid) and time.monotonic() < end:
        time.sleep(0.02)
    assert not is_alive(pid)
