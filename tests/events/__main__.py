"""Campaigns of hybrid systems with closed-form event times, and of models in other units: python -m tests.events
belts|systems|automata|swings|units [--draws N]."""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
import sys
import tempfile

import numpy as np

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.events import belts, hybrid, in_units, play, swings
from tests.events.judge import wrong
from tests.events.models import compiled

TOLERANCES = tuple(10 ** (-k / 2) for k in range(8, 21))  # 1e-4 to 1e-10 in half decades


def run_belts(draws: int) -> int:
    """Print shares of the error budget by solver and tolerance; the number of wrong runs."""
    model = runtime.Model(compile_model(str(belts.MODEL)).path)
    rng, shares, errors, wrong = np.random.default_rng(2026), defaultdict(list), defaultdict(list), 0
    for n in range(draws):
        belt = belts.draw(rng)
        for solver in belts.SOLVERS:
            for rtol in TOLERANCES:
                verdict = belts.judge(model, belt, solver, rtol)
                shares[solver, rtol].append(verdict.share)
                errors[solver, rtol].append(verdict.error)
                if verdict.wrong:
                    wrong += 1
                    print(f"draw {n}, {solver}, rtol {rtol:.1e}: {verdict.wrong}; {belt}")
    for (solver, rtol), values in shares.items():
        error = np.array(errors[solver, rtol])
        off = f"{np.median(error):.2e} s (median), {error.max():.2e} s (largest)"
        print(f"{solver:8s} {rtol:8.1e}  event times off by {off}, {max(values):.2f} of the budget")
    print(f"{wrong} of {sum(map(len, shares.values()))} runs wrong")
    return wrong


Drawn = tuple[str, str, Callable[..., str]]  # what a model is called, its text, what judges a run of it


def _run_all(draws: int, draw: Callable[[int], Drawn], tolerances: Sequence[float]) -> int:
    """Each drawn model by all adaptive solvers: right, or ended by an error; the number of wrong runs."""
    verdicts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number in range(draws):
            name, text, judge = draw(number)
            model = compiled(Path(folder), text)
            for solver in belts.SOLVERS:
                for rtol in tolerances:
                    said = judge(model, solver=solver, rtol=rtol)
                    verdicts["right" if not said else "error" if said.startswith("error") else "wrong"] += 1
                    if said:
                        print(f"{name} {number}, {solver}, rtol {rtol:.1e}: {said}", flush=True)
    print(", ".join(f"{count} {what}" for what, count in verdicts.items()), f"of {verdicts.total()} runs")
    return verdicts["wrong"]


def run_systems(draws: int) -> int:
    """Random hybrid systems: each right within its budget, or ended by an error."""
    rng = np.random.default_rng(2026)

    def draw(number: int) -> Drawn:
        system = hybrid.draw(rng, number)
        return hybrid.KINDS[number % 4], system.text, partial(wrong, system=system)

    return _run_all(draws, draw, TOLERANCES)


def run_automata(draws: int) -> int:
    """Random automata against a program that plays them on their closed forms."""

    def draw(number: int) -> Drawn:
        automaton, expected = play.fair(np.random.default_rng([2027, number]), number)

        def judge(model: runtime.Model, solver: str, rtol: float) -> str:
            result = runtime.simulate(model, solver=solver, rtol=rtol, stop=automaton.stop, interval=0)
            return play.wrong(automaton, expected, result, rtol)

        return "automaton", automaton.text, judge

    return _run_all(draws, draw, TOLERANCES[::3])


def run_swings(draws: int) -> int:
    """Small swings beside large states: right within their budget, or ended by an error."""

    def draw(number: int) -> Drawn:
        swing = swings.draw(np.random.default_rng([2028, number]), number)
        return "swing", swing.text, partial(swings.wrong, swing=swing)

    return _run_all(draws, draw, swings.TOLERANCES)


CIRCUITS = (
    "Electrical.Analog.Examples.Rectifier", "Electrical.Analog.Examples.HeatingRectifier",
    "Electrical.Analog.Examples.ControlledSwitchWithArc", "Electrical.Analog.Examples.NandGate",
    "Electrical.Analog.Examples.ShowSaturatingInductor", "Electrical.Analog.Examples.OvervoltageProtection",
    "Electrical.Analog.Examples.DemoPowerSupply", "Electrical.Analog.Examples.OpAmps.SignalGenerator",
    "Mechanics.Translational.Examples.ElastoGap", "Mechanics.Rotational.Examples.CoupledClutches",
)  # fmt: skip


def run_units(count: int) -> int:
    """T1, T2, FlightControlEma and circuits of the Modelica Standard Library in other units; the number of faults."""
    from bench.generated import T1, T2, model_file
    from bench.msl import shared_folder

    models = [(str(model_file(T1)), 2.0), (str(model_file(T2)), None), ("Actuators.FlightControlEma", None)]
    models += [(f"Modelica.{name}", None) for name in CIRCUITS]
    faults = []
    with tempfile.TemporaryDirectory() as cache:
        for name, stop in models[:count]:
            found = in_units.compare(name, stop, cache, [str(shared_folder())])
            print(*found.lines, *found.faults, sep="\n", flush=True)
            faults += found.faults
    print(f"{len(faults)} faults")
    return len(faults)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("campaign", choices=["belts", "systems", "automata", "swings", "units"])
    parser.add_argument("--draws", type=int, default=None)
    arguments = parser.parse_args()
    run, draws = {
        "belts": (run_belts, 200),
        "systems": (run_systems, 520),
        "automata": (run_automata, 400),
        "swings": (run_swings, 300),
        "units": (run_units, 100),
    }[arguments.campaign]
    return 1 if run(arguments.draws or draws) else 0


if __name__ == "__main__":
    sys.exit(main())
