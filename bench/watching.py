"""From the save of an equation to the new figure: what `lacuna simulate --watch` and `lacuna maps --watch` take."""

from __future__ import annotations

from collections.abc import Callable, Iterator
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

        def simulated() -> Any:
            return lacuna.load("Actuators.EccentricBldc", **options).simulate().plot("winding.a.i", "rotor.w")

        def mapped() -> Iterator[Any]:
            for done in lacuna.growing_map("Actuators.EccentricBldc", **options, out=Path(folder) / "map"):
                yield done.plot()

        return [
            *_measured(("simulate, a pre-flight test",), simulated, library, rounds),
            *_measured(("maps, 11 severities", "maps, all 51"), mapped, library, rounds),
        ]


def _measured(
    names: tuple[str, ...], draw: Callable[[], Any], library: Path, rounds: int
) -> Iterator[dict[str, object]]:
    """A row for each of the figures that `draw` gives one after another."""
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
    number = 0
    for _ in names:
        number = _beyond(heard[0], number)
    file = library / EDITED
    source = (MODEL_FOLDER / EDITED).read_text(encoding="utf-8")
    seconds: dict[str, list[float]] = {name: [] for name in names}
    for k in range(rounds):
        begin = time.perf_counter()
        term = f"{BEFORE} + {time.time_ns() % 10**9 + k}e-15*zeta"
        file.write_text(source.replace(BEFORE, term), encoding="utf-8")
        for name in names:
            number = _beyond(heard[0], number)
            seconds[name].append(time.perf_counter() - begin)
    stop.set()
    watching.join()
    for name, taken in seconds.items():
        yield {"figure": name, "median s": statistics.median(taken), "longest s": max(taken), "saves": rounds}


def _beyond(address: str, number: int) -> int:
    """The number of the first figure beyond `number`, when the page has it."""
    found = {"number": number, "message": ""}
    while found["number"] <= number:
        with urlopen(f"{address}{number}") as answer:
            found = json.load(answer)
    if found["message"]:
        raise RuntimeError(str(found["message"]))
    return int(found["number"])
