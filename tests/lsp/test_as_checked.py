"""After each edit of a large model the server says what `lacuna check` says of that text, read for the first time: all
but whether the model can be solved by itself, which is asked of its structure."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import shutil

import pytest

import lacuna
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.search_path import MODEL_FOLDER
from lacuna.lsp.features import Workspace

INSIDE = Path("Actuators", "FlightControlEma.mo")
HINGE = "connect(surface.flange_b, hinge.flange_a);"
POWER = "delivered.power = aero.delivered;"
EDITS = [
    ("backlash(final min=0) = 0", "backlash(final min=0) = 1e-3"),
    ("N(final min=1) = 160", "N(final min=1) = 0"),
    ("N(final min=1) = 160", "N(final min=1) = 160 + time"),
    ("Types.Inertia Js", "Types.Inertai Js"),
    ("Types.Torque tau_s", "Types.Angle tau_s"),
    ("gear(ratio=N)", "gear(ratoi=N)"),
    ("gear(ratio=N)", "gear(ratio=Js)"),
    ("surface(J=Js", "surface(J=Jz"),
    ("Components.Mechanics.Inertia surface", "Components.Mechanics.Spring surface"),
    ("  Components.Mechanics.ViscousFriction hinge(b=bs) ", "  // "),
    (HINGE, ""),
    (HINGE, "connect(surface.flange_b, hinge.flange_c);"),
    (HINGE, "connect(surface.flange_b, command.y);"),
    (POWER, ""),
    (POWER, "delivered.power = aero.tau;"),
    (POWER, "delivered.power = 2*aero.delivered + stored;"),
    (POWER, POWER + "\n  rubbed.power = if N > 1 then nothing else hinge.loss;"),
    (POWER, POWER + "\n  when surface.w > travel then reinit(surface.w, 0); end when;"),
    ("i_limit=15", "i_limti=15"),
    ("controller(N=N, Kp=18", "controller(N=N, Kp=18, nn=1"),
    ("end FlightControlEma;", "  model Types end Types;\nend FlightControlEma;"),
    ("Documentation(info", "Evaluat=true, Documentation(info"),
]


@pytest.fixture
def found_of(tmp_path: Path) -> Callable[[str], tuple[list[str], list[str]]]:
    """What a server that has seen all edits so far says of the text, and what a check of it as a saved file says."""
    edited, saved = (tmp_path / name / "model" for name in ("edited", "saved"))
    for folder in (edited, saved):
        shutil.copytree(MODEL_FOLDER, folder)
    space = Workspace([str(MODEL_FOLDER)])

    def found(text: str) -> tuple[list[str], list[str]]:
        space.change(edited / INSIDE, text)
        (saved / INSIDE).write_text(text, encoding="utf-8")
        by_server = [_without_source(str(f)) for f in space.view(edited / INSIDE).findings]
        return by_server, [_without_source(f).replace(str(saved), str(edited)) for f in _checked(saved / INSIDE)]

    return found


def _without_source(finding: str) -> str:
    """Without the marked line, which is read from the disk."""
    return "\n".join(line for line in finding.split("\n") if not line.startswith(" " * 6))


def _checked(path: Path) -> list[str]:
    try:
        return [str(w) for w in lacuna.check(path).warnings if "by itself this cannot be simulated" not in str(w)]
    except Diagnostic as first:
        return [str(f) for f in (first, *first.others)]


def test_each_edit_is_found_as_a_check_finds_it(found_of: Callable[[str], tuple[list[str], list[str]]]) -> None:
    text, refused = (MODEL_FOLDER / INSIDE).read_text(encoding="utf-8"), 0
    for old, new in EDITS:
        assert text.count(old) == 1, old
        for edited in (text.replace(old, new), text):
            by_server, by_check = found_of(edited)
            assert by_server == by_check, (old, new)
            refused += bool(by_server)
    assert refused >= len(EDITS) // 2


def test_each_letter_of_an_equation_is_found_as_a_check_finds_it(
    found_of: Callable[[str], tuple[list[str], list[str]]],
) -> None:
    text = (MODEL_FOLDER / INSIDE).read_text(encoding="utf-8")
    for end in range(len(POWER) + 1):
        by_server, by_check = found_of(text.replace(POWER, POWER[:end]))
        assert by_server == by_check, POWER[:end]


def test_a_class_that_comes_to_a_folder_is_seen_by_the_next_edit(tmp_path: Path) -> None:
    """What was not there is not looked for again, unless a folder has changed: the package's, or one of the path."""
    package, beside = tmp_path / "P", tmp_path / "beside"
    for folder in (package, beside):
        folder.mkdir()
    (package / "package.mo").write_text("package P end P;\n", encoding="utf-8")
    top, text = package / "Top.mo", "within P;\nmodel Top\n  NAME part;\nend Top;\n"
    top.write_text(text, encoding="utf-8")
    space = Workspace([str(beside), str(MODEL_FOLDER)])

    def codes(name: str) -> list[str]:
        space.change(top, text.replace("NAME", name))
        return [f.code for f in space.view(top).findings]

    assert codes("Part") == ["R001"] and codes("Other") == ["R001"]
    (package / "Part.mo").write_text("within P;\nmodel Part end Part;\n", encoding="utf-8")
    assert codes("Part") == [] and codes("Other") == ["R001"]
    (beside / "Other.mo").write_text("model Other end Other;\n", encoding="utf-8")
    assert codes("Other") == [] and codes("Part") == []
