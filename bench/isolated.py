"""Many independent jobs, each in a process of its own: a crash, a loop without end or a lack of memory costs one job.

Results are JSON files in one folder, named by job; a job whose result is there and was made by the same generator and
runtime is not run again. What a job may take is processor time, its compiler's included: a busy machine ends none.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
import hashlib
import json
import os
from pathlib import Path
import resource
import signal
import sys
import time
import traceback

import psutil

from lacuna.codegen.cache import generator_version
from lacuna.runtime.library import library_path

Outcome = dict[str, object]
MEMORY = 4 << 30  # bytes of address space for one job
PATIENCE = 4  # times as long a job may take by the clock: it waits for a processor, or for ever


def run_all(
    jobs: Iterable[str],
    work: Callable[[str], Outcome],
    folder: Path,
    *,
    timeout: float,
    workers: int = 2,
    keep: bool = False,
    progress: bool = True,
) -> dict[str, Outcome]:
    """The outcome of every job, by its name. `keep` takes any result that is there, whatever generator made it."""
    folder.mkdir(parents=True, exist_ok=True)
    version = f"{generator_version()} {hashlib.sha256(library_path().read_bytes()).hexdigest()}"
    results: dict[str, Outcome] = {}
    waiting: list[str] = []
    for job in jobs:
        known = _stored(folder, job)
        if known is not None and (keep or known.get("generator") == version):
            results[job] = known
        else:
            waiting.append(job)
    running: dict[int, tuple[str, float]] = {}
    while waiting or running:
        while waiting and len(running) < workers:
            job = waiting.pop(0)
            running[_start(job, work, folder, version)] = (job, time.monotonic())
        for pid, (job, since) in list(running.items()):
            finished, status = os.waitpid(pid, os.WNOHANG)
            if not finished:
                if not (reason := _too_long(pid, time.monotonic() - since, timeout)):
                    continue
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)
                _store(folder, job, {"status": "timeout", "message": reason, "generator": version})
            elif status:
                reason = f"the process ended with signal {os.WTERMSIG(status)}"
                _store(folder, job, {"status": "crash", "message": reason, "generator": version})
            del running[pid]
            results[job] = _stored(folder, job) or {"status": "crash", "message": "no result"}
            if progress:
                print(f"{len(results):4d} {results[job]['status']:10s} {job}", file=sys.stderr, flush=True)
        time.sleep(0.01)
    return results


def _too_long(pid: int, since: float, timeout: float) -> str:
    """Why a job that has run for `since` seconds by the clock is ended; nothing where it may go on."""
    if _processor_seconds(pid) > timeout:
        return f"more than {timeout:g} s of processor time"
    return f"more than {PATIENCE * timeout:g} s, most of them waiting" if since > PATIENCE * timeout else ""


def _processor_seconds(pid: int) -> float:
    """What a running job and the children that it waited for have taken, s."""
    times = psutil.Process(pid).cpu_times()
    return times.user + times.system + times.children_user + times.children_system


def _start(job: str, work: Callable[[str], Outcome], folder: Path, version: str) -> int:
    pid = os.fork()
    if pid:
        return pid
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    try:
        outcome = work(job)
    except BaseException:  # whatever it is: a crash of the translator is what this looks for
        outcome = {"status": "crash", "message": "".join(traceback.format_exc()[-1500:])}
    _store(folder, job, {**outcome, "seconds": _processor_seconds(os.getpid()), "generator": version})
    os._exit(0)


def _store(folder: Path, job: str, outcome: Outcome) -> None:
    beside = folder / f"{job}.tmp"
    beside.write_text(json.dumps(outcome, indent=1))
    beside.replace(folder / f"{job}.json")


def _stored(folder: Path, job: str) -> Outcome | None:
    try:
        return json.loads((folder / f"{job}.json").read_text())
    except (OSError, ValueError):
        return None
