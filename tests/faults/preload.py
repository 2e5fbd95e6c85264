"""The preloaded library that makes calls fail, and the process that has it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import ctypes
from dataclasses import dataclass
import os
from pathlib import Path
import subprocess
import sys

SHIM = Path(__file__).with_name("shim.c")


def with_shim(folder: Path, words: Sequence[str], output: int | None = None) -> subprocess.CompletedProcess[str]:
    """Run `python -m tests.faults` in a process that has the shim; `output` is where it prints."""
    library = folder / "shim.so"
    subprocess.run(["cc", "-std=gnu11", "-O1", "-shared", "-fPIC", "-o", library, SHIM, "-ldl"], check=True)
    command = [sys.executable, "-m", "tests.faults", *words]
    settings = os.environ | {"LD_PRELOAD": str(library), "MPLBACKEND": "Agg", "OPENBLAS_NUM_THREADS": "1"}
    return subprocess.run(command, env=settings, text=True, cwd=SHIM.parents[2], stdout=output)


@dataclass(frozen=True)
class Fault:
    """Call `number` that changes something below the folder fails, and, where `lasting`, all after it."""

    number: int
    error: int
    lasting: bool

    def __str__(self) -> str:
        return f"call {self.number} {'and on' if self.lasting else 'alone'}: {os.strerror(self.error)}"


@dataclass(frozen=True)
class Outcome:
    status: int  # as a shell sees it
    said: str  # on both outputs
    calls: int  # that would have changed something
    unsynced: str  # the last file that got its name before the disk had its content


def run_with(fault: Fault, folder: Path, work: Callable[[], int], log: Path) -> Outcome:
    """`work` in a child of this process, in which calls fail."""
    shim = ctypes.CDLL(None)
    shim.fault_calls.restype, shim.fault_unsynced.restype = ctypes.c_long, ctypes.c_char_p
    shim.fault_arm.argtypes = [ctypes.c_char_p, ctypes.c_long, ctypes.c_int, ctypes.c_int]
    sys.stdout.flush()
    shim.fault_arm(b"", 0, 0, 0)
    child = os.fork()
    if child == 0:
        _as_child(work, log, lambda: shim.fault_arm(bytes(folder), fault.number, fault.error, fault.lasting))
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    said, calls, unsynced = log.read_text(encoding="utf-8", errors="replace"), shim.fault_calls(), shim.fault_unsynced()
    shim.fault_arm(b"", 0, 0, 0)  # it is armed for both
    return Outcome(status, said, calls, unsynced.decode())


def _as_child(work: Callable[[], int], log: Path, arm: Callable[[], None]) -> None:
    handle = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    os.dup2(handle, 1)
    os.dup2(handle, 2)
    status = 71
    try:
        arm()
        status = work()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
