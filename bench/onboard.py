"""The on-board assessment chain against the clock, on one core of this machine."""

from __future__ import annotations

from pathlib import Path
import subprocess

import numpy as np

PROGRAM = Path(__file__).parents[1] / "build" / "bin" / "onboard_speed"
STREAM = 10  # s of a stream in each round: ten records


def against_the_clock(rounds: int) -> list[dict[str, object]]:
    """One row: seconds of stream over processor seconds, the median of `rounds` and the slowest."""
    taken = [float(subprocess.check_output([PROGRAM, str(STREAM)], text=True)) for _ in range(rounds)]
    return [
        {
            "stream, s": STREAM,
            "processor, s": float(np.median(taken)),
            "times real time": STREAM / float(np.median(taken)),
            "slowest": STREAM / max(taken),
        }
    ]
