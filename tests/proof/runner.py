"""Runs a diagnosis over the proof's cases, one process a case; finished cases are skipped by content hash."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
import hashlib
import json
import os
from pathlib import Path
import shutil
import subprocess
import tempfile
import time

ROOT = Path(__file__).parents[2]
GENERATOR_SOURCES = (
    *("kernel", "effects", "benches.py", "case.py", "excitation.py", "generate.py"),
    *("plan.py", "refit.py", "simulator.py", "write.py"),
)
TOOL_SOURCES = ("discovery", "codegen", "runtime", "model", "cli/explain.py")
USUAL_SOURCES = ("baseline.py", "equations.py", "naming.py", "refit.py", "benches.py", "simulator.py", "kernel")


def content_hash(paths: Sequence[Path]) -> str:
    """Of every source or data file among and below the paths."""
    digest = hashlib.sha256()
    for path in paths:
        below = path.rglob("*") if path.is_dir() else [path]
        for file in sorted(f for f in below if f.is_file() and f.suffix not in (".pyc", ".so")):
            digest.update(str(file.relative_to(path.parent)).encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:20]


def tool_hash() -> str:
    """Of the code and the models that a diagnosis depends on."""
    return content_hash([ROOT / name for name in TOOL_SOURCES])


def usual_hash() -> str:
    """Of the code that a diagnosis by the usual alternative depends on."""
    return content_hash([Path(__file__).parent / name for name in USUAL_SOURCES])


def generator_hash() -> str:
    """Of the code that the cases depend on."""
    return content_hash([Path(__file__).parent / name for name in GENERATOR_SOURCES])


def finished(out: Path, version: str) -> bool:
    """Whether `out` holds the outcome of a diagnosis by this version."""
    stamp = out / "run.json"
    return stamp.exists() and json.loads(stamp.read_text())["key"].startswith(version)


def _run(command: Sequence[str], timeout: float) -> tuple[str, str]:
    """Status and last words of a command, on one thread of linear algebra: cases run side by side."""
    environment = os.environ | dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
    environment["PYTHONPATH"] = str(ROOT)
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=timeout, cwd=ROOT, env=environment)
    except subprocess.TimeoutExpired:
        return "out of time", f"no diagnosis within {timeout:.0f} s"
    return ("ok" if run.returncode == 0 else f"exit {run.returncode}"), run.stderr[-2000:]


def diagnose(command: Sequence[str], case: Path, out: Path, version: str, timeout: float) -> str:
    """Runs COMMAND CASE --out DIR on a copy of the case and keeps diagnosis.json and run.json in `out`.

    run.json is there only when everything else is, so that a run that was killed is done again.
    """
    key = f"{version}-{content_hash([case])}"
    if finished(out, key):
        return "kept"
    with tempfile.TemporaryDirectory(prefix="proof-") as scratch:
        copy, result, kept = (Path(scratch) / name for name in (case.name, "out", "kept"))
        shutil.copytree(case, copy)
        started = time.monotonic()
        status, message = _run([*command, str(copy), "--out", str(result)], timeout)
        seconds = time.monotonic() - started
        kept.mkdir()
        if status == "ok" and (result / "diagnosis.json").exists():
            shutil.copy(result / "diagnosis.json", kept)
        elif status == "ok":
            status = "no diagnosis"
        run = {"key": key, "seconds": seconds, "status": status, "message": message}
        (kept / "run.json").write_text(json.dumps(run))
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        for name in ("diagnosis.json", "run.json"):
            if (kept / name).exists():
                shutil.copy(kept / name, out / f".{name}")
                (out / f".{name}").rename(out / name)
    return status


def run_all(names: Sequence[str], work: Callable[[str], str], jobs: int) -> None:
    """`work(name)` for every name, `jobs` at a time; says after each how many are done and how long the rest takes.

    The first error, or Ctrl-C, drops what has not begun.
    """
    started, fresh = time.monotonic(), 0
    pool = ThreadPoolExecutor(jobs)
    try:
        pending = {pool.submit(work, name): name for name in names}
        for k, done in enumerate(as_completed(pending), start=1):
            status = done.result()
            fresh += status != "kept"
            left = (time.monotonic() - started) / max(fresh, 1) * (len(names) - k) / 60
            print(f"[{k}/{len(names)}] {pending[done]} {status}, about {left:.0f} min left", flush=True)
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
