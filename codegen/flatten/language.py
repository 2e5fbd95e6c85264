"""The language as a whole: every kind of expression and every built-in function, with what gives its value."""

from __future__ import annotations

from lacuna.codegen.flatten.connections.overconstrained import STATEMENTS, is_root, rooted
from lacuna.codegen.flatten.connections.streams import actual_stream, in_stream
from lacuna.codegen.flatten.connections.structure import cardinality
from lacuna.codegen.flatten.expressions import arrays, lower, operators
from lacuna.codegen.flatten.expressions.reduce import reductions
from lacuna.codegen.flatten.functions import calls, overloads
from lacuna.codegen.flatten.functions.kept.code import run
from lacuna.codegen.flatten.names.context import Lowering
from lacuna.codegen.flatten.references import iterators, open_ranges
from lacuna.codegen.flatten.references.references import read, read_part
from lacuna.codegen.syntax import ast

_OF_CONNECTIONS = {
    "cardinality": cardinality,
    "inStream": in_stream,
    "actualStream": actual_stream,
    "Connections.isRoot": is_root,
    "Connections.rooted": rooted,
    "rooted": rooted,
}
LOWERING = Lowering(
    nodes={
        **lower.OPERATORS,
        ast.Binary: reductions.binary,
        ast.Ref: read,
        ast.Part: read_part,
        ast.Call: calls.lower_call,
        **iterators.RANGES,
    },
    functions={
        **_OF_CONNECTIONS,
        **arrays.FUNCTIONS,
        **reductions.FUNCTIONS,
        **operators.SCALAR_FUNCTIONS,
        **operators.OPERATORS,
    },
    words=calls.WORDS | {*STATEMENTS},
    results=calls.call_of_model,
    overloaded=overloads.overloaded,
    construct=overloads.construct,
    text=overloads.text_by_operator,
    run=run,
    expanded=open_ranges.expanded,
)
