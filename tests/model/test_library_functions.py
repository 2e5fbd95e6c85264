"""External functions of the Modelica Standard Library by our own implementations: texts, streams, spectra, random."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.search_path import search_path
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import Result, simulate

MODELS = Path(__file__).parents[1] / "models" / "library"


def run(name: str, shared: Path) -> Result:
    """A test model of this folder on the library, one second."""
    library = shared / "msl"
    if not library.is_dir():
        pytest.skip(f"needs the Modelica Standard Library; not at {library}")
    compiled = compile_model(str(MODELS / f"{name}.mo"), search_path=search_path([library]))
    result = simulate(Model(compiled.path), stop=1.0, interval=0.01)
    assert result.complete, result.failure
    return result


def test_texts_are_scanned(shared: Path) -> None:
    """By hand; the calculator is an example of the library itself."""
    found = run("Texts", shared).parameters
    assert found["number"] == 125.0
    assert (found["whole"], found["place"], found["length"]) == (4, 7, 4)
    assert found["product"] == 14.0


def test_lines_of_a_file_are_read(shared: Path) -> None:
    text = (shared / "msl/Modelica/Resources/Data/Electrical/Digital/Memory_Matrix.txt").read_text(encoding="utf-8")
    found, lines = run("Lines", shared).parameters, text.splitlines()
    assert found["count"] == len(lines)
    assert [found["second"], found["third"]] == [len(lines[1]), len(lines[2])]


def test_a_spectrum_is_that_of_numpy(shared: Path) -> None:
    """Sizes with factors 2, 3 and 5, at run time and at translation."""
    result = run("Spectra", shared)
    for n in (12, 30):
        u = np.array([result[f"u{n}[{k}]"][-1] for k in range(1, n + 1)])
        wanted = 2 / n * np.fft.rfft(u)
        found = np.array([result[f"A{n}[{k}]"][-1] for k in range(1, n // 2 + 2)])
        angle = np.array([result[f"P{n}[{k}]"][-1] for k in range(1, n // 2 + 2)])
        np.testing.assert_allclose(found * np.exp(1j * angle), wanted, atol=1e-13)
    fixed = [result.parameters[f"fixed[{k}]"] for k in range(1, 5)]
    np.testing.assert_allclose(fixed, 2 / 6 * np.abs(np.fft.rfft([1, 2, 4, 8, 16, 32])), rtol=1e-14)


def test_impure_random_numbers_are_uniform_and_repeat(shared: Path) -> None:
    """1001 numbers: their mean is within four standard deviations of 1/2; two calls are independent to as much."""
    first, again = run("Impure", shared), run("Impure", shared)
    np.testing.assert_array_equal(first["a"], again["a"])
    n = 1001
    assert abs(first["sum"][-1] / n - 0.5) < 4 / np.sqrt(12 * n)
    assert abs(first["product"][-1] / n) < 4 / 12 / np.sqrt(n)
