"""How long a fleet takes, and whether one that was killed ends alike: `python -m bench.fleet_scale --actuators 100000`.

Histories of 50 tests are drawn by the laws of the prognosis study, watched for 20 to 95 % of a life, with plain noise:
what is measured is time, not truth. Prints seconds by the clock and of the processors, of every stage.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
from pathlib import Path
import resource
import shutil
import subprocess
import sys
import time

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from bench.prognosis.truth import KNOWN, UNKNOWN, draw

TESTS, LIMIT = 50, 0.34
NOISE, OUTLIERS, MISSING = 0.006, 0.02, 0.05
LIVES = 500  # lives that histories are made of
BLOCK = 10_000  # histories a block of the file


def write_fleet(path: Path, actuators: int, seed: int = 7) -> None:
    """A Parquet file of histories, drawn by `seed`."""
    random = np.random.default_rng(seed)
    lives = [draw(str(random.choice(KNOWN + UNKNOWN)), random) for _ in range(LIVES)]
    with pq.ParquetWriter(path, _table(lives, 0, 1, random).schema) as writer:
        for first in range(0, actuators, BLOCK):
            writer.write_table(_table(lives, first, min(BLOCK, actuators - first), random))


def _table(lives: list, first: int, count: int, random: np.random.Generator) -> pa.Table:
    gaps = random.lognormal(0, 0.3, (count, TESTS))
    use = np.cumsum(gaps, axis=1)
    share = random.uniform(0.2, 0.95, count)[:, None] * use / use[:, -1:]
    of = random.integers(len(lives), size=count)
    severity = LIMIT * np.array(
        [np.interp(s, lives[k].time, lives[k].severity) for s, k in zip(share, of, strict=True)]
    )
    outlier = random.random(severity.shape) < OUTLIERS
    severity = np.where(outlier, random.uniform(0, 0.5, severity.shape), severity)
    read = np.clip(severity + NOISE * random.standard_normal(severity.shape), 0.0, 0.5).ravel()
    read[random.random(read.size) < MISSING] = np.nan
    half = 1.96 * NOISE
    pace = np.exp(random.uniform(np.log(20), np.log(500), (count, 1)))
    return pa.table(
        {
            "actuator": np.repeat([f"A{first + k:06d}" for k in range(count)], TESTS),
            "cycles": (pace * use).ravel(),
            "severity": read,
            "low": read - half,
            "high": read + half,
        }
    )


def _processors() -> float:
    """Seconds of all processors, of this process and of those that it has waited for."""
    used = [resource.getrusage(of) for of in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in used)


def _command(table: Path, out: Path) -> list[str]:
    return [sys.executable, "-m", "lacuna.cli.main", "fleet", str(table), "--out", str(out)]


def timed(table: Path, out: Path) -> dict[str, float]:
    """Seconds of `lacuna fleet`, by the clock and of the processors, and the most memory of a process."""
    begun, used = time.monotonic(), _processors()
    subprocess.run(_command(table, out), check=True, stdout=subprocess.DEVNULL)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return {"seconds": time.monotonic() - begun, "processor seconds": _processors() - used, "most MB": memory}


def killed_and_resumed(table: Path, out: Path, chunks: int) -> bool:
    """Whether a run that is killed once `chunks` are kept, and begun again, ends with the bytes of `out`."""
    again = out.with_name(f"{out.name}-again")
    shutil.rmtree(again, ignore_errors=True)
    run = subprocess.Popen(_command(table, again), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                           start_new_session=True)  # fmt: skip
    while run.poll() is None and len(list((again / "parts").glob("*.parquet"))) < chunks:
        time.sleep(0.2)
    interrupted = run.poll() is None
    if interrupted:
        os.killpg(run.pid, 9)
    run.wait()
    subprocess.run(_command(table, again), check=True, stdout=subprocess.DEVNULL)
    digests = [hashlib.sha256((folder / "fleet.parquet").read_bytes()).hexdigest() for folder in (out, again)]
    return interrupted and digests[0] == digests[1]


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m bench.fleet_scale", description=__doc__)
    parser.add_argument("--actuators", type=int, default=10_000)
    parser.add_argument("--out", type=Path, default=Path("out/fleet-scale"))
    parser.add_argument("--kill", type=int, default=0, metavar="CHUNKS", help="also kill a run after so many chunks")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    table, out = arguments.out / f"{arguments.actuators}.parquet", arguments.out / str(arguments.actuators)
    shutil.rmtree(out, ignore_errors=True)
    if not table.exists():
        write_fleet(table, arguments.actuators)
    found: dict[str, object] = {"actuators": arguments.actuators, "tests": TESTS, **timed(table, out)}
    if arguments.kill:
        found["killed and resumed alike"] = killed_and_resumed(table, out, arguments.kill)
    print(json.dumps(found))


if __name__ == "__main__":
    main()
