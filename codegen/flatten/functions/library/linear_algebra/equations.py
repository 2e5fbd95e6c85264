"""What Modelica.Math.Matrices asks of LAPACK to solve linear equations (solve, solve2, LU, LU_solve, inv, det), as
functions of the language: Gaussian elimination with the largest element of a column as pivot (G. Golub, C. Van Loan,
Matrix Computations, algorithm 3.4.1).
"""

from __future__ import annotations

from functools import lru_cache

from lacuna.codegen.flatten.functions.kept.code import run_or_emit
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.names.values import Array, Value, shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast, parse

_FACTOR = """
  for k in 1:min(size(LU, 1), size(LU, 2)) loop
    p := k;
    for i in k + 1:size(LU, 1) loop
      if abs(LU[i, k]) > abs(LU[p, k]) then
        p := i;
      end if;
    end for;
    pivots[k] := p;
    for j in 1:size(LU, 2) loop
      t := LU[k, j];
      LU[k, j] := LU[p, j];
      LU[p, j] := t;
    end for;
    if LU[k, k] == 0 then
      info := if info == 0 then k else info;
    else
      for i in k + 1:size(LU, 1) loop
        LU[i, k] := LU[i, k]/LU[k, k];
        for j in k + 1:size(LU, 2) loop
          LU[i, j] := LU[i, j] - LU[i, k]*LU[k, j];
        end for;
      end for;
    end if;
  end for;
"""
_SUBSTITUTE = """
  if info == 0 then
    for j in 1:size(X, 2) loop
      for k in 1:size(LU, 1) loop
        t := X[k, j];
        X[k, j] := X[pivots[k], j];
        X[pivots[k], j] := t;
      end for;
      for i in 2:size(LU, 1) loop
        for k in 1:i - 1 loop
          X[i, j] := X[i, j] - LU[i, k]*X[k, j];
        end for;
      end for;
      for i in size(LU, 1):-1:1 loop
        for k in i + 1:size(LU, 1) loop
          X[i, j] := X[i, j] - LU[i, k]*X[k, j];
        end for;
        X[i, j] := X[i, j]/LU[i, i];
      end for;
    end for;
  end if;
"""
_TEXT = f"""
function dgetrf "Row k was exchanged with row pivots[k]; info: the first pivot that is 0"
  input Real A[:, :];
  output Real LU[size(A, 1), size(A, 2)] = A;
  output Integer pivots[min(size(A, 1), size(A, 2))];
  output Integer info = 0;
protected
  Integer p;
  Real t;
algorithm
{_FACTOR}
end dgetrf;

function dgetrs "X with A*X = B, by the factors of A"
  input Real LU[:, :];
  input Integer pivots[:];
  input Real B[:, :];
  output Real X[size(B, 1), size(B, 2)] = B;
  output Integer info = 0;
protected
  Real t;
algorithm
{_SUBSTITUTE}
end dgetrs;

function dgesv "X with A*X = B; B itself where A is singular"
  input Real A[:, :];
  input Real B[:, :];
  output Real X[size(B, 1), size(B, 2)] = B;
  output Integer info = 0;
protected
  Real LU[size(A, 1), size(A, 2)] = A;
  Integer pivots[size(A, 1)];
  Integer p;
  Real t;
algorithm
{_FACTOR}
{_SUBSTITUTE}
end dgesv;
"""


@lru_cache(maxsize=1)
def _functions() -> dict[str, ast.Class]:
    return {cls.name: cls for cls in parse(_TEXT, "equations.mo")}


def _run(name: str, call: ExternalCall, **given: Value) -> list[Value]:
    return run_or_emit(_functions()[name], given, call.scope.context, call.span)


def _column(b: Array) -> Array:
    """A right-hand side as a matrix."""
    return b if len(b.shape) == 2 else Array((*b.shape, 1), b.items)


def _factors(values: list[Value], call: ExternalCall) -> list[Value]:
    """(A): the factors, the pivots, info."""
    return _run("dgetrf", call, A=values[0])


def _solved(values: list[Value], call: ExternalCall) -> list[Value]:
    """(A, B): X of the shape of B, info."""
    matrix, b = values
    x, info = _run("dgesv", call, A=matrix, B=_column(b))
    return [Array(b.shape, x.items), info]


def _solved_by_factors(values: list[Value], call: ExternalCall) -> list[Value]:
    """(LU, pivots, B): X of the shape of B, info."""
    lu, pivots, b = values
    x, info = _run("dgetrs", call, LU=lu, pivots=pivots, B=_column(b))
    return [Array(b.shape, x.items), info]


def _inverse(values: list[Value], call: ExternalCall) -> list[Value]:
    """(LU, pivots): the inverse, info."""
    lu, pivots = values
    n = shape_of(lu)[0]
    unit = Array((n, n), tuple(ex.const(float(i == j)) for i in range(n) for j in range(n)))
    return _solved_by_factors([lu, pivots, unit], call)


LINEAR_EQUATIONS: dict[str, Handler] = {
    "dgesv": _solved, "dgetrf": _factors, "dgetrs": _solved_by_factors, "dgetri": _inverse,
}  # fmt: skip
