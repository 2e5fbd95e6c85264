"""Modelica.Math.Random.Utilities.impureRandom without a hidden state: a number from the time and the place of the call.

So it is the same in every run, whatever steps a solver takes and however often an event is iterated, and calls at one
instant differ. The mixing is that of splitmix64 (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014), in
emit/functions/random_numbers.py.
"""

from __future__ import annotations

from dataclasses import dataclass

from lacuna.codegen import flat
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.symbolic import expr as ex

_NAME = "impureRandom"
_INPUTS = ("id", "instant", "call")


@dataclass
class _Calls:
    """How many calls have been met."""

    count: int = 0


def _number(values: list[Value], call: ExternalCall) -> list[Value]:
    """(id): a number above 0 and up to 1."""
    context = call.scope.context
    calls = context.table(_Calls)
    calls.count += 1
    if _NAME not in context.functions:
        names = (*_INPUTS, "y")
        context.functions[_NAME] = flat.Function(
            _NAME, _INPUTS, ("y",), dict.fromkeys(names, ()), dict.fromkeys(names, ex.REAL), {},
            [flat.Native("impure_random", _INPUTS, ("y",), call.span)], call.span,
        )  # fmt: skip
    return [ex.call(_NAME, values[0], ex.TIME, ex.const(float(calls.count)), type=ex.REAL)]


def _kept(values: list[Value], call: ExternalCall) -> list[Value]:
    """The state of the library's generator, which nobody reads here."""
    return []


IMPURE: dict[str, Handler] = {
    "ModelicaRandom_impureRandom_xorshift1024star": _number,
    "ModelicaRandom_setInternalState_xorshift1024star": _kept,
}
