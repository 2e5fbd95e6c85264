"""Structures and enumerations of the binding are those of the headers: asked of the C compiler, not of a copy."""

from __future__ import annotations

import ctypes
import os
from pathlib import Path
import subprocess

import pytest

from lacuna.runtime import library

INCLUDE = Path(__file__).parents[2] / "runtime/include"
STRUCTURES = {
    library.CVariable: "mdl_variable", library.CEquation: "mdl_equation", library.CRelation: "mdl_relation",
    library.CDescriptor: "mdl_descriptor", library.CFailure: "rt_failure", library.CCounters: "rt_counters",
    library.CEvent: "rt_event_entry", library.CFlag: "rt_flag", library.COptions: "rt_options",
}  # fmt: skip
ONLY_THE_HEAD = {library.CDescriptor}
ENUMERATIONS = {
    "STATUS": ("RT_", library.STATUS), "EVENT_KINDS": ("RT_EVENT_", library.EVENT_KINDS),
    "FLAG_KINDS": ("RT_FLAG_", library.FLAG_KINDS), "STORAGE": ("MDL_", library.STORAGE),
    "TYPES": ("MDL_", library.TYPES),
}  # fmt: skip
SPELT = {"non_finite": "NONFINITE"}


def asked(folder: Path, questions: list[str]) -> list[int]:
    """The values of integer constant expressions of C."""
    body = "".join(f'  printf("%lld\\n", (long long)({q}));\n' for q in questions)
    head = '#include <stddef.h>\n#include <stdio.h>\n#include "lacuna_runtime.h"\n'
    text = f"{head}int main(void) {{\n{body}  return 0;\n}}\n"
    source, program = folder / "ask.c", folder / "ask"
    source.write_text(text)
    subprocess.run([os.environ.get("CC", "cc"), f"-I{INCLUDE}", str(source), "-o", str(program)], check=True)
    return [int(line) for line in subprocess.run([str(program)], check=True, capture_output=True).stdout.split()]


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda s: s.__name__)
def test_members_lie_where_the_compiler_puts_them(structure: type[ctypes.Structure], tmp_path: Path) -> None:
    name, members = STRUCTURES[structure], [field[0] for field in structure._fields_]
    places = [f"offsetof({name}, {m})" for m in members]
    sizes = [f"sizeof((({name} *)0)->{m})" for m in members]
    *found, whole = asked(tmp_path, [*places, *sizes, f"sizeof({name})"])
    expected = [getattr(structure, m).offset for m in members] + [getattr(structure, m).size for m in members]
    assert dict(zip([*places, *sizes], found, strict=True)) == dict(zip([*places, *sizes], expected, strict=True))
    assert whole == ctypes.sizeof(structure) or (structure in ONLY_THE_HEAD and whole > ctypes.sizeof(structure))


@pytest.mark.parametrize("enumeration", ENUMERATIONS)
def test_enumerations_have_the_values_of_the_headers(enumeration: str, tmp_path: Path) -> None:
    prefix, names = ENUMERATIONS[enumeration]
    constants = [prefix + SPELT.get(n, n.upper()) for n in names]
    assert asked(tmp_path, constants) == list(range(len(names)))
