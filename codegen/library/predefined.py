"""Classes that the language itself declares."""

from __future__ import annotations

from lacuna.codegen.syntax import parse

_PREDEFINED = """
type StateSelect = enumeration(never, avoid, default, prefer, always);
type AssertionLevel = enumeration(warning, error);
partial class ExternalObject end ExternalObject;
"""  # Modelica 3.6, 4.9.8, 8.3.7 and 12.9.7
PREDEFINED = {cls.name: cls for cls in parse(_PREDEFINED, "")}
PRIMITIVES = ("Real", "Integer", "Boolean", "String")
