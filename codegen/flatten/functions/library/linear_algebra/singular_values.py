"""What Modelica.Math.Matrices asks of LAPACK for singular values and least squares (norm, singularValues, rank,
conditionNumber, nullSpace, leastSquares), as functions of the language: the columns of A are made orthogonal by plane
rotations (M. Hestenes 1958; G. Golub, C. Van Loan, Matrix Computations, section 8.6.3). The signs of singular vectors
are not LAPACK's.
"""

from __future__ import annotations

from functools import lru_cache

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.functions.kept.code import run_or_emit
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.names.values import Array, Value, shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast, parse

_TEXT = """
function decomposed "A = U*diagonal(sigma)*transpose(V); A has no fewer rows than columns"
  input Real A[:, :];
  output Real sigma[size(A, 2)] "falling";
  output Real U[size(A, 1), size(A, 1)];
  output Real V[size(A, 2), size(A, 2)] = identity(size(A, 2));
  output Integer info "1: columns are not orthogonal after 60 sweeps";
protected
  constant Real eps = 2.220446049250313e-16;
  Real W[size(A, 1), size(A, 2)] = A;
  Integer m = size(A, 1);
  Integer n = size(A, 2);
  Integer sweep = 0;
  Integer best;
  Real a, b, c, d, s, t, most;
  Real length = 0 "of A: what is less than its rounding is orthogonal to all";
algorithm
  for i in 1:m loop
    for j in 1:n loop
      length := length + A[i, j]^2;
    end for;
  end for;
  length := sqrt(length);
  U := zeros(size(A, 1), size(A, 1));
  info := 1;
  while info > 0 and sweep < 60 loop
    sweep := sweep + 1;
    info := 0;
    for p in 1:n - 1 loop
      for q in p + 1:n loop
        a := 0;
        b := 0;
        d := 0;
        for i in 1:m loop
          a := a + W[i, p]^2;
          b := b + W[i, q]^2;
          d := d + W[i, p]*W[i, q];
        end for;
        if abs(d) > m*eps*sqrt(a)*sqrt(b) and sqrt(min(a, b)) > m*eps*length then
          info := 1;
          t := (b - a)/(2*d);
          t := (if t < 0 then -1 else 1)/(abs(t) + sqrt(1 + t^2));
          c := 1/sqrt(1 + t^2);
          s := c*t;
          for i in 1:m loop
            a := W[i, p];
            W[i, p] := c*a - s*W[i, q];
            W[i, q] := s*a + c*W[i, q];
          end for;
          for i in 1:n loop
            a := V[i, p];
            V[i, p] := c*a - s*V[i, q];
            V[i, q] := s*a + c*V[i, q];
          end for;
        end if;
      end for;
    end for;
  end while;
  for j in 1:n loop
    sigma[j] := 0;
    for i in 1:m loop
      sigma[j] := sigma[j] + W[i, j]^2;
    end for;
    sigma[j] := sqrt(sigma[j]);
  end for;
  for j in 1:n loop
    best := j;
    for k in j + 1:n loop
      best := if sigma[k] > sigma[best] then k else best;
    end for;
    t := sigma[j];
    sigma[j] := sigma[best];
    sigma[best] := t;
    for i in 1:m loop
      t := W[i, j];
      W[i, j] := W[i, best];
      W[i, best] := t;
    end for;
    for i in 1:n loop
      t := V[i, j];
      V[i, j] := V[i, best];
      V[i, best] := t;
    end for;
  end for;
  for j in 1:m loop
    a := 0;
    if j <= n then
      a := if sigma[j] > m*eps*sigma[1] then sigma[j] else 0;
    end if;
    if a > 0 then
      for i in 1:m loop
        U[i, j] := W[i, j]/a;
      end for;
    else
      best := 1;
      most := -1;
      for k in 1:m loop
        t := 1;
        for l in 1:j - 1 loop
          t := t - U[k, l]^2;
        end for;
        best := if t > most then k else best;
        most := max(most, t);
      end for;
      U[best, j] := 1;
      for twice in 1:2 loop
        for l in 1:j - 1 loop
          d := 0;
          for i in 1:m loop
            d := d + U[i, l]*U[i, j];
          end for;
          for i in 1:m loop
            U[i, j] := U[i, j] - d*U[i, l];
          end for;
        end for;
      end for;
      d := 0;
      for i in 1:m loop
        d := d + U[i, j]^2;
      end for;
      for i in 1:m loop
        U[i, j] := U[i, j]/sqrt(d);
      end for;
    end if;
  end for;
end decomposed;

function least "X of least norm among those for which A*X is nearest to B: X = V*diagonal(1/sigma)*transpose(U)*B"
  input Real B[:, :];
  input Real rcond;
  input Real sigma[:];
  input Real U[:, :];
  input Real V[:, :];
  input Integer rows "of X, what is not of the solution is zero";
  output Real X[rows, size(B, 2)];
  output Integer rank;
protected
  Real t;
algorithm
  rank := 0;
  X := zeros(rows, size(B, 2));
  for k in 1:size(sigma, 1) loop
    if sigma[k] > rcond*sigma[1] then
      rank := rank + 1;
      for j in 1:size(B, 2) loop
        t := 0;
        for i in 1:size(B, 1) loop
          t := t + U[i, k]*B[i, j];
        end for;
        for i in 1:size(V, 1) loop
          X[i, j] := X[i, j] + V[i, k]*t/sigma[k];
        end for;
      end for;
    end if;
  end for;
end least;
"""


@lru_cache(maxsize=1)
def _functions() -> dict[str, ast.Class]:
    return {cls.name: cls for cls in parse(_TEXT, "singular_values.mo")}


def _run(name: str, call: ExternalCall, **given: Value) -> list[Value]:
    return run_or_emit(_functions()[name], given, call.scope.context, call.span)


def _transposed(a: Array) -> Array:
    rows, columns = a.shape
    return Array((columns, rows), tuple(a.items[i * columns + j] for j in range(columns) for i in range(rows)))


def _decomposed(matrix: Value, call: ExternalCall) -> tuple[Array, Array, Array, Value]:
    """(sigma, U, V, info), of a matrix of any shape."""
    rows, columns = shape_of(matrix)
    if not isinstance(matrix, Array) or not rows or not columns:
        raise Diagnostic("R062", "the singular values of an empty matrix", call.span, "give it rows and columns")
    sigma, u, v, info = _run("decomposed", call, A=_transposed(matrix) if rows < columns else matrix)
    assert isinstance(sigma, Array)
    assert isinstance(u, Array)
    assert isinstance(v, Array)
    return (sigma, v, u, info) if rows < columns else (sigma, u, v, info)


def _singular_values(values: list[Value], call: ExternalCall) -> list[Value]:
    """(A): sigma, U, V transposed, info, or without vectors, sigma and info, as the function that asks has outputs."""
    sigma, u, v, info = _decomposed(values[0], call)
    return [sigma, info] if call.cls.name == "dgesvd_sigma" else [sigma, u, _transposed(v), info]


def _least_squares(values: list[Value], call: ExternalCall) -> list[Value]:
    """(A, B, rcond): X of as many rows as the longer side of A, rank, info."""
    matrix, b, rcond = values
    sigma, u, v, info = _decomposed(matrix, call)
    assert isinstance(b, Array)
    column = b if len(b.shape) == 2 else Array((*b.shape, 1), b.items)
    rows = max(shape_of(matrix))
    x, rank = _run("least", call, B=column, rcond=rcond, sigma=sigma, U=u, V=v, rows=ex.const(rows))
    assert isinstance(x, Array)
    return [x if len(b.shape) == 2 else Array((rows,), x.items), rank, info]


SINGULAR_VALUES: dict[str, Handler] = {"dgesvd": _singular_values, "dgelsy": _least_squares}
