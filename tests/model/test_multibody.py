"""Mechanisms of the Modelica Standard Library with closed loops: energy kept, and two formulations that agree."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.search_path import search_path
from lacuna.runtime.model import Model
from lacuna.runtime.result import Result
from lacuna.runtime.simulation import simulate

EXAMPLES = "Modelica.Mechanics.MultiBody.Examples"
STANDARD_GRAVITY = 9.80665  # m/s2, the library's default
RTOL = 1e-9
TURNS = 3.0  # s, some three turns of the crank


@pytest.fixture(scope="module")
def library(shared: Path) -> Path:
    folder = shared / "msl"
    if not folder.is_dir():
        pytest.skip(f"needs the Modelica Standard Library; not at {folder}")
    return folder


def run(name: str, library: Path) -> Result:
    compiled = compile_model(f"{EXAMPLES}.{name}", search_path=search_path([library]))
    result = simulate(Model(compiled.path), stop=TURNS, rtol=RTOL, interval=0.05, events=False)
    assert result.complete, result.failure
    return result


def energies(result: Result, body: str) -> tuple[np.ndarray, np.ndarray]:
    """(kinetic, potential) energy of a rigid body in J over time, from its position, orientation and speeds."""
    axes = (1, 2, 3)

    def vector(name: str) -> np.ndarray:
        return np.array([result[f"{body}.{name}[{i}]"] for i in axes])

    def matrix(name: str) -> np.ndarray:
        return np.array([[result[f"{body}.{name}[{i},{j}]"] for j in axes] for i in axes])

    mass, turn, omega, centre = result[f"{body}.m"], matrix("frame_a.R.T"), vector("w_a"), vector("r_CM")
    speed = vector("v_0") + np.einsum("jit,jt->it", turn, np.cross(omega, centre, axis=0))
    height = (vector("r_0") + np.einsum("jit,jt->it", turn, centre))[1]
    spin = np.einsum("it,ijt,jt->t", omega, matrix("I"), omega)
    return (mass * np.sum(speed**2, axis=0) + spin) / 2, mass * STANDARD_GRAVITY * height


@pytest.mark.parametrize(
    ("name", "bodies"),
    [("Loops.Fourbar1", ["b1.body", "b2.body", "b3.body"]), ("Loops.Fourbar2", ["b1.body", "b2.body"])],
)
def test_a_mechanism_without_friction_keeps_its_energy(name: str, bodies: list[str], library: Path) -> None:
    result = run(name, library)
    kinetic, potential = np.sum([energies(result, body) for body in bodies], axis=0)
    assert np.ptp(kinetic) > 10, "the crank turns unevenly"
    # each of some 10^4 steps may be wrong by the tolerance of the states
    assert np.ptp(kinetic + potential) <= 1e4 * RTOL * np.max(kinetic)


def test_a_loop_cut_by_constraints_moves_like_one_solved_in_closed_form(library: Path) -> None:
    cut, closed = run("Loops.Fourbar2", library), run("Loops.Fourbar_analytic", library)
    angle = cut["j1.phi"]
    assert np.ptp(angle) > 2 * np.pi
    assert np.max(np.abs(angle - closed["j1.phi"])) <= 1e4 * RTOL * np.ptp(angle)
