"""Runs a diagnosis over the proof's cases, one process a case; finished cases are skipped by content hash."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
import hashlib
import json
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
TOOL_SOURCES = ("discovery", "codegen", "runtime", "model", "cli")


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


def generator_hash() -> str:
    """Of the code that the cases depend on."""
    return content_hash([Path(__file__).parent / name for name in GENERATOR_SOURCES])


def diagnose(command: Sequence[str], case: Path, out: Path, version: str, timeout: float) -> str:
    """Runs COMMAND CASE --out DIR on a copy of the case and keeps diagnosis.json and run.json in `out`."""
    key = f"{version}-{content_hash([case])}"
    stamp = out / "run.json"
    if stamp.exists() and json.loads(stamp.read_text())["key"] == key:
        return "kept"
    with tempfile.TemporaryDirectory(prefix="proof-") as scratch:
        copy, result = Path(scratch) / case.name, Path(scratch) / "out"
        shutil.copytree(case, copy)
        started = time.monotonic()
        try:
            run = subprocess.run(
                [*command, str(copy), "--out", str(result)], capture_output=True, text=True, timeout=timeout, cwd=ROOT
            )
            status, message = ("ok" if run.returncode == 0 else f"exit {run.returncode}"), run.stderr[-2000:]
        except subprocess.TimeoutExpired:
            status, message = "timeout", f"no diagnosis within {timeout:.0f} s"
        seconds = time.monotonic() - started
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        if (result / "diagnosis.json").exists():
            shutil.copy(result / "diagnosis.json", out)
        elif status == "ok":
            status = "no diagnosis"
        stamp.write_text(json.dumps({"key": key, "seconds": seconds, "status": status, "message": message}))
    return status


def run_all(names: Sequence[str], work: Callable[[str], str], jobs: int, report: Callable[[str, str], None]) -> None:
    """`work(name)` for every name, `jobs` at a time, each result reported as it comes."""
    with ThreadPoolExecutor(jobs) as pool:
        pending = {pool.submit(work, name): name for name in names}
        for done in as_completed(pending):
            report(pending[done], done.result())
