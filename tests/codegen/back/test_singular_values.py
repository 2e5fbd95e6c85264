"""Singular values and least squares of Modelica.Math.Matrices, of parameters and in the run, against NumPy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lacuna

MODEL = """model Values
  import Modelica.Math.Matrices.*;
  parameter Real A[3,3] = [1,2,3; 4,5,6; 7,8,10];
  parameter Real B[2,4] = [1,2,3,4; 2,4,6,8.5];
  constant Real R[3,3] = [1,2,3; 2,4,6; 1,0,1];
  Real norm_A = norm(A), cond_A = conditionNumber(A), rank_R = rank(R);
  Real of_A[3] = singularValues(A), of_B[2] = singularValues(B), of_R[3] = singularValues(R);
  Real wide[4] = leastSquares(B, {1,2}), tall[2] = leastSquares(transpose(B), {1,2,3,4 + time});
  Real moving = norm([1 + time, 2; 0, 1]);
  Real sigma[2], U[2,2], VT[4,4];
equation
  (sigma, U, VT) = singularValues((1 + time)*B);
end Values;
"""
A = np.array([[1, 2, 3], [4, 5, 6], [7, 8, 10.0]])
B = np.array([[1, 2, 3, 4], [2, 4, 6, 8.5]])
R = np.array([[1, 2, 3], [2, 4, 6], [1, 0, 1.0]])


def test_they_are_those_of_numpy(tmp_path: Path, shared: Path) -> None:
    library = shared / "msl"
    if not (library / "Modelica").is_dir():
        pytest.skip("the Modelica Standard Library is not there")
    path = tmp_path / "Values.mo"
    path.write_text(MODEL, encoding="utf-8")
    found = lacuna.load(path, libraries=[library]).simulate(stop=1.0, interval=0.25)

    def last(name: str, *shape: int) -> np.ndarray:
        return np.array([found[f"{name}[{','.join(str(k + 1) for k in at)}]"][-1] for at in np.ndindex(shape)])

    accurate = {"rtol": 1e-13, "atol": 1e-13}
    np.testing.assert_allclose(found["norm_A"][-1], np.linalg.norm(A, 2), **accurate)
    np.testing.assert_allclose(found["cond_A"][-1], np.linalg.cond(A), rtol=1e-12)
    assert found["rank_R"][-1] == 2
    for name, matrix in (("of_A", A), ("of_B", B), ("of_R", R)):
        values = np.linalg.svd(matrix)[1]
        np.testing.assert_allclose(last(name, len(values)), values, rtol=1e-13, atol=1e-14 * values[0])
    np.testing.assert_allclose(last("wide", 4), np.linalg.lstsq(B, [1, 2], rcond=None)[0], **accurate)
    np.testing.assert_allclose(last("tall", 2), np.linalg.lstsq(B.T, [1, 2, 3, 5], rcond=None)[0], **accurate)
    norms = [np.linalg.norm([[1 + t, 2], [0, 1]], 2) for t in found.time]
    np.testing.assert_allclose(found["moving"], norms, **accurate)
    u, vt = last("U", 2, 2).reshape(2, 2), last("VT", 4, 4).reshape(4, 4)
    np.testing.assert_allclose(u @ np.diag(last("sigma", 2)) @ vt[:2], 2 * B, **accurate)
    np.testing.assert_allclose(vt @ vt.T, np.eye(4), **accurate)
    np.testing.assert_allclose(u.T @ u, np.eye(2), **accurate)
