"""The discrete Fourier transform of Modelica.Math.FastFourierTransform, a function of the language.

Autosort of mixed radix (G. Stockham; C. Van Loan, Computational Frameworks for the Fast Fourier Transform, SIAM 1992,
sections 1.7, 2.4): a[j*m + k] are transforms of length l of every m-th sample from the k-th on, n = l*m; a stage
joins r of them. It takes n times the sum of the factors of n.
"""

from __future__ import annotations

from functools import lru_cache

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.functions.kept.code import run_or_emit
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.names.values import Array, Value
from lacuna.codegen.syntax import ast, parse

_TEXT = """
function rawRealFFT "Amplitudes of cosines, and their phases (rad), of n samples; the first is twice the mean"
  input Real u[:];
  output Integer info "1: n is not even";
  output Real amplitudes[div(size(u, 1), 2) + 1];
  output Real phases[div(size(u, 1), 2) + 1];
protected
  Integer n = size(u, 1);
  Real a[size(u, 1)] = u "real parts, and";
  Real b[size(u, 1)] "imaginary parts";
  Real c[size(u, 1)];
  Real d[size(u, 1)];
  Integer l = 1;
  Integer m = size(u, 1);
  Integer r;
  Integer from;
  Real angle;
algorithm
  info := mod(n, 2);
  for i in 1:n loop
    b[i] := 0;
  end for;
  while m > 1 loop
    r := 2;
    while mod(m, r) > 0 loop
      r := r + 1;
    end while;
    m := div(m, r);
    for j in 0:l*r - 1 loop
      for k in 1:m loop
        c[j*m + k] := 0;
        d[j*m + k] := 0;
      end for;
      for s in 0:r - 1 loop
        angle := -2*3.14159265358979323846*mod(j*s, l*r)/(l*r);
        from := mod(j, l)*m*r + m*s;
        for k in 1:m loop
          c[j*m + k] := c[j*m + k] + cos(angle)*a[from + k] - sin(angle)*b[from + k];
          d[j*m + k] := d[j*m + k] + cos(angle)*b[from + k] + sin(angle)*a[from + k];
        end for;
      end for;
    end for;
    for i in 1:n loop
      a[i] := c[i];
      b[i] := d[i];
    end for;
    l := l*r;
  end while;
  for i in 1:div(n, 2) + 1 loop
    amplitudes[i] := 2/n*sqrt(a[i]^2 + b[i]^2);
    phases[i] := atan2(b[i], a[i]);
  end for;
end rawRealFFT;
"""


@lru_cache(maxsize=1)
def _function() -> ast.Class:
    return parse(_TEXT, "spectrum.mo")[0]


def _transform(values: list[Value], call: ExternalCall) -> list[Value]:
    """(u, size(u, 1)): what ModelicaFFT_kiss_fftr gives."""
    samples = values[0]
    if not isinstance(samples, Array) or not samples.items:
        raise Diagnostic("R062", "the spectrum of no samples", call.span, "give a vector of samples")
    return run_or_emit(_function(), {"u": samples}, call.scope.context, call.span)


SPECTRA: dict[str, Handler] = {"ModelicaFFT_kiss_fftr": _transform}
