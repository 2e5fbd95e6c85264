"""The solvers of linear equations that a generated model carries: as the compiler takes them, and against LAPACK's."""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.cache import compile_c
from lacuna.codegen.emit.functions.linear import solved
from lacuna.codegen.emit.functions.prelude import helpers


@pytest.mark.parametrize("n", range(2, 12))
@pytest.mark.parametrize("quick", [False, True])
def test_a_block_of_a_known_size(tmp_path: Path, n: int, quick: bool) -> None:
    """The size is a number at each call: what the compiler makes of it must neither be wrong nor warn."""
    call = f"int solve(double *a, double *b) {{ return {solved(n, 'a', 'b')}; }}"
    source, library = tmp_path / "solve.c", tmp_path / "solve.so"
    source.write_text(f"#include <math.h>\n{helpers(call)}\nint solve(double *a, double *b);\n{call}\n")
    compile_c(source, library, quick=quick)
    random = np.random.default_rng(n)
    matrix, right = random.standard_normal((n, n)), random.standard_normal(n)
    a, b = matrix.copy(), np.concatenate([right, np.zeros(n)])
    pointers = [ctypes.c_void_p(v.ctypes.data) for v in (a, b)]
    assert ctypes.CDLL(str(library)).solve(*pointers) == 0
    bound = n**2 * np.linalg.cond(matrix) * np.finfo(float).eps  # Higham, Accuracy and Stability, theorem 9.4
    expected = np.linalg.solve(matrix, right)
    assert np.linalg.norm(b[:n] - expected) <= bound * np.linalg.norm(expected)
