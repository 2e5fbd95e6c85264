"""The language as a whole: every kind of expression and every built-in function, with what gives its value."""

from __future__ import annotations

from lacuna.codegen.flatten import arrays, calls, iterators, lower
from lacuna.codegen.flatten.context import Lowering
from lacuna.codegen.flatten.functions import run
from lacuna.codegen.flatten.references import read
from lacuna.codegen.syntax import ast

LOWERING = Lowering(
    nodes={**lower.OPERATORS, ast.Ref: read, ast.Call: calls.lower_call, **iterators.RANGES},
    functions={**arrays.FUNCTIONS, **calls.SCALAR_FUNCTIONS, **calls.OPERATORS},
    results=calls.call_of_model,
    run=run,
)
