"""Models translated, run, and compared with what the oracle says of them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
import random
import shutil
import traceback

import numpy as np

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from tests.fuzz.oracle import meaning as m
from tests.fuzz.oracle.machines import Machine
from tests.fuzz.oracle.places import PARAMETERS, SIGNALS, TIMES, Probe, draw_probe
from tests.fuzz.oracle.play import APART, Play
from tests.fuzz.oracle.programs import declared

SOLVERS = ("ida", "dopri5", "rodas4", "rk4")
# Relative, of the largest value of the probe and 1. What is a function of time is exact but for rounding, which a
# difference of numbers of size LARGEST = 1e6 leaves at some 1e-10; nonlinear blocks are solved, and states of machines
# integrated, to the relative tolerance of 1e-8, a hundredth of this.
WRONG = 1e-6


@dataclass(frozen=True)
class Finding:
    place: str
    what: str  # "wrong", "refused CODE", "ended", "crashed"
    detail: str
    model: str


def draw_probes(dice: random.Random, count: int) -> list[Probe]:
    probes: list[Probe] = []
    while len(probes) < count:
        try:
            probes.append(draw_probe(dice, f"y{len(probes)}"))
        except m.Unfit:
            continue
    return probes


def model_of(probes: list[Probe]) -> str:
    lines = ["model M", "  type E = enumeration(a, b, c);"]
    lines += [p.classes for p in probes if p.classes]
    lines += [f"  {declared(n, kind, 'parameter ', text)}" for n, (kind, text, _) in PARAMETERS.items()]
    lines += [f"  {declared(n, kind, value=text)}" for n, (kind, text, _) in SIGNALS.items()]
    lines += [f"  {line}" for p in probes for line in p.declarations]
    lines += ["equation", *(f"  {line}" for p in probes for line in p.equations if not line.startswith("initial"))]
    for probe in probes:
        if probe.algorithm:
            lines += ["algorithm", *(f"  {line}" for line in probe.algorithm)]
    lines += [line for p in probes for line in p.equations if line.startswith("initial")]
    return "\n".join([*lines, "end M;", ""])


def run(text: str, folder: Path, solver: str) -> runtime.Result | tuple[str, str]:
    """The whole run of a model, or what happened instead."""
    name = text.split()[1]
    path, store = folder / f"{name}.mo", folder / "cache"
    path.write_text(text, encoding="utf-8")
    try:
        model = runtime.Model(compile_model(f"{path}:{name}", cache_directory=str(store)).path)
        result = runtime.simulate(
            model, solver=solver, rtol=1e-8, step=1e-3, stop=1.0, output_times=TIMES, events=False, patience=5,
        )  # fmt: skip
    except Diagnostic as refused:
        return f"refused {refused.code}", str(refused)
    except runtime.SimulationError as ended:
        return "ended", str(ended)
    except Exception as error:
        return "crashed", f"{type(error).__name__}: {error}\n{traceback.format_exc(limit=-6)}"
    finally:
        shutil.rmtree(store, ignore_errors=True)
    return result if result.failure is None else ("ended", str(result.failure))


def try_probes(probes: list[Probe], folder: Path, solver: str) -> list[Finding]:
    """What is not as it should be; a model that is refused or ends is halved until one probe is left."""
    text = model_of(probes)
    result = run(text, folder, solver)
    if isinstance(result, runtime.Result):
        return [f for p in probes if (f := compare(p, result))]
    if len(probes) > 1:
        half = len(probes) // 2
        found = try_probes(probes[:half], folder, solver) + try_probes(probes[half:], folder, solver)
        return found or [Finding("together", *result, text)]
    return [Finding(probes[0].place, *result, text)]


def compare(probe: Probe, result: runtime.Result) -> Finding | None:
    columns = {at: result[name] for at, name in _elements(probe).items()}
    worth = [probe.worth(float(t)) for t in TIMES]
    size = max(1.0, *(float(np.max(np.abs(np.asarray(w, float)))) for w, _ in worth))
    for row, (t, (value, close)) in enumerate(zip(TIMES, worth, strict=True)):
        if close:
            continue
        for at, column in columns.items():
            expected = float(np.asarray(value)[at])
            if not abs(float(column[row]) - expected) <= WRONG * size:
                name = f"{probe.name}{[k + 1 for k in at] or ''}"
                return Finding(probe.place, "wrong", _differs(name, t, column[row], expected), model_of([probe]))
    return None


def _differs(name: str, t: float, found: float, expected: float) -> str:
    return f"{name} at t = {t:.4f}: {float(found)!r}, and the oracle says {expected!r}"


def _elements(probe: Probe) -> dict[tuple[int, ...], str]:
    if not probe.kind.shape:
        return {(): probe.name}
    return {at: f"{probe.name}[{','.join(str(k + 1) for k in at)}]" for at in np.ndindex(*probe.kind.shape)}


def try_machine(machine: Machine, play: Play, folder: Path, solver: str) -> list[Finding]:
    """Compared where no event is near, up to where the oracle can tell the order of events."""
    result = run(machine.text, folder, solver)
    if not isinstance(result, runtime.Result):
        return [Finding("machine", *result, machine.text)]
    begins = np.array([s.begin for s in play.stretches])
    for row, t in enumerate(TIMES):
        if t >= play.until or np.min(np.abs(begins - t)) < APART:
            continue
        stretch = play.stretches[int(np.searchsorted(begins, t)) - 1]
        moved = zip(stretch.states, stretch.rates, strict=True)
        states = {f"x{k}": x + rate * (t - stretch.begin) for k, (x, rate) in enumerate(moved)}
        for name, expected in {**stretch.values, **states}.items():
            if not abs(float(result[name][row]) - float(expected)) <= WRONG * max(1.0, abs(float(expected))):
                detail = _differs(name, t, result[name][row], float(expected))
                return [Finding("machine", "wrong", f"{solver}: {detail}", machine.text)]
    return []
