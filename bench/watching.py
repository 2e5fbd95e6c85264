"""From the save of an equation to the new figure: what `lacuna simulate --watch` and `lacuna maps --watch` take."""

from __future__ import annotations

from collections.abc import Callable
import json
from pathlib import Path
import shutil
import statistics
import tempfile
import threading
import time
from typing import Any
from urllib.request import urlopen

import lacuna

MODEL_FOLDER = Path(__file__).parents[1] / "model"
EDITED = "Components/Drives/StarWinding.mo"
BEFORE = "1 + zeta*cos(hall.theta_e - pi/3)"


def from_save_to_figure(rounds: int) -> list[dict[str, object]]:
    """A row for each figure: median and longest of `rounds` saves, s, each of an equation that was not there before."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "model"
        shutil.copytree(MODEL_FOLDER, library)
        options: dict[str, Any] = {"libraries": [library]}
        figures: dict[str, Callable[[], Any]] = {
            "simulate, a pre-flight test": lambda: (
                lacuna.load("Actuators.EccentricBldc", **options).simulate().plot("winding.a.i", "rotor.w")
            ),
            "maps, 51 severities": lambda: lacuna.maps(
                "Actuators.EccentricBldc", **options, out=Path(folder) / "map", figures=False
            ).plot(),
        }
        return [_measured(name, draw, library, rounds) for name, draw in figures.items()]


def _measured(name: str, draw: Callable[[], Any], library: Path, rounds: int) -> dict[str, object]:
    heard: list[str] = []
    stop, ready = threading.Event(), threading.Event()

    def opened(address: str) -> None:
        heard.append(address)
        ready.set()

    def follow() -> None:
        lacuna.watch(draw, [library], opened=opened, told=lambda _: None, stop=stop)

    watching = threading.Thread(target=follow)
    watching.start()
    ready.wait()
    number = _beyond(heard[0], 0)
    file = library / EDITED
    source, seconds = (MODEL_FOLDER / EDITED).read_text(encoding="utf-8"), []
    for k in range(rounds):
        begin = time.perf_counter()
        term = f"{BEFORE} + {time.time_ns() % 10**9 + k}e-15*zeta"
        file.write_text(source.replace(BEFORE, term), encoding="utf-8")
        number = _beyond(heard[0], number)
        seconds.append(time.perf_counter() - begin)
    stop.set()
    watching.join()
    return {"figure": name, "median s": statistics.median(seconds), "longest s": max(seconds), "saves": rounds}


def _beyond(address: str, number: int) -> int:
    """The number of the first figure beyond `number`, when the page has it."""
    found = {"number": number, "message": ""}
    while found["number"] <= number:
        with urlopen(f"{address}{number}") as answer:
            found = json.load(answer)
    if found["message"]:
        raise RuntimeError(str(found["message"]))
    return int(found["number"])
