"""Generated models under the sanitizers of a build folder: python -m tests.sanitize BUILD.

Their C is compiled with the same sanitizers, with sensitivities, and run by all solvers in four threads at once
(run_models.cpp): the sanitizers say nothing, and equal runs give equal bytes.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import re
import subprocess
import sys
import tempfile

import numpy as np

from bench.generated import T1, T2, model_file
from lacuna.codegen.cache import COMPILER, INCLUDE
from lacuna.codegen.compile import translate
from lacuna.codegen.emit.source import generate
from lacuna.codegen.library.search_path import search_path
from tests.events import belts, play

ROOT = Path(__file__).parents[2]
AUTOMATA = 6
SECONDS = {"T1": 0.05, "T2": 0.005, "FlightControlEma": 0.1, "Pendulum": 5.0, "Belt": 5.0}


def sources(folder: Path) -> Iterator[tuple[str, str]]:
    """(name, C) of motors with switches, an actuator, an automatic choice of states, stick and slip, and automata."""
    named = {
        "T1": str(model_file(T1)),
        "T2": str(model_file(T2)),
        "FlightControlEma": "Actuators.FlightControlEma",
        "Belt": str(belts.MODEL),
        "Pendulum": str(_written(folder, _PENDULUM)),
    }
    for number in range(AUTOMATA):
        automaton, _ = play.fair(np.random.default_rng([2027, number]), number)
        named[f"Automaton{number}"] = str(_written(folder, automaton.text))
    for name, model in named.items():
        prepared, _ = translate(model, search_path=search_path([]))
        yield name, generate(prepared, name != "Pendulum")  # states that are chosen in the run have no derivatives


_PENDULUM = """model Pendulum "In x and y, through full turns"
  Real x(start=1, fixed=true), y(start=0), vx, vy(start=-5, fixed=true), F;
equation
  der(x) = vx;
  der(y) = vy;
  der(vx) = -F*x;
  der(vy) = -F*y - 9.81;
  x^2 + y^2 = 1;
end Pendulum;
"""


def _written(folder: Path, text: str) -> Path:
    path = folder / f"{text.split()[1]}.mo"
    path.write_text(text)
    return path


def sanitizers(build: Path) -> str:
    found = re.search(r"^LACUNA_SANITIZE:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)
    value = found.group(1) if found else "OFF"
    return {"ON": "address,undefined", "OFF": ""}.get(value, value)


def main() -> int:
    build = Path(sys.argv[1])
    flags = [f"-fsanitize={sanitizers(build)}", "-fno-sanitize-recover=all", "-g"] if sanitizers(build) else []
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name, text in sources(folder):
            (folder / f"{name}.c").write_text(text)
            library = str(folder / f"{name}.so")
            compiler = [*COMPILER, *flags, f"-I{INCLUDE}", "-o", library, str(folder / f"{name}.c"), "-lm"]
            subprocess.run(compiler, check=True)
            stop = str(SECONDS.get(name, 1.0))
            run = subprocess.run([build / "bin/run_models", stop, library], capture_output=True, text=True)
            failed += run.returncode != 0
            print(f"{name}: {'as it should be' if not run.returncode else run.stdout + run.stderr}", flush=True)
            print(*(f"  {line.split(' ', 1)[1]}" for line in run.stdout.splitlines()), sep="\n", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
