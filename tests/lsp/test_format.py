"""The formatter keeps the tokens, so the meaning; formatting twice is formatting once; our own library stands still."""

from __future__ import annotations

from pathlib import Path
import random

import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.cli.main import app
from lacuna.codegen.flat.text import dump_flat
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax.lexer import tokenize

ROOT = Path(__file__).parents[2]
OURS = sorted((ROOT / "model").rglob("*.mo"))


def words(text: str) -> list[str]:
    return tokenize(text, "").words


def test_our_own_library_is_formatted() -> None:
    assert [p.name for p in OURS if lacuna.format_model(text := p.read_text(encoding="utf-8")) != text] == []


def disordered(text: str, seed: int) -> str:
    """Every line that begins outside strings and comments moved sideways, empty lines doubled."""
    choice, inside, lines = random.Random(seed), False, []
    for line in text.split("\n"):
        moved = line if inside else " " * choice.randrange(9) + line.lstrip() + " " * choice.randrange(3)
        quotes = line.replace('\\"', "").count('"')
        lines += [moved if not (inside ^ bool(quotes % 2)) else moved.rstrip()]
        inside ^= bool(quotes % 2)
        if not line.strip() and not inside:
            lines.append("")
    return "\n".join(lines)


@pytest.mark.parametrize("path", OURS[::6], ids=lambda p: p.stem)
def test_tokens_stay_and_a_second_time_changes_nothing(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for seed in range(3):
        formatted = lacuna.format_model(disordered(text, seed))
        assert words(formatted) == words(text)
        assert lacuna.format_model(formatted) == formatted


def test_the_flat_model_is_the_same(tmp_path: Path) -> None:
    text = (ROOT / "tests/models/SquareWaveServo.mo").read_text(encoding="utf-8")
    flat = []
    for folder, body in (("a", text), ("b", lacuna.format_model(disordered(text, 1)))):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "SquareWaveServo.mo").write_text(body, encoding="utf-8")
        flat.append(dump_flat(flatten(Library(), str(tmp_path / folder / "SquareWaveServo.mo"))))
    assert flat[0] == flat[1]


def test_nesting() -> None:
    text = """\
package P "Nested"
model M
Real x;
protected
parameter Real a = if true then 1
    else 2;
equation
if a > 1 then
x = if time > 1 then 1 else 2;
elseif a > 0 then
x = 2;
else
for i in 1:2 loop
x = i;
end for;
end if;
initial equation
when x > 1 then
reinit(x, 2);
elsewhen x > 2 then
terminate("so");
end when;
end M;
type T = Real(unit="m");
function f
input Real u;
output Real y;
algorithm
while u > 1 loop
y := u;
end while;
end f;
end P;
"""
    indents = [len(line) - len(line.lstrip()) for line in lacuna.format_model(text).splitlines()]
    wanted = "0 2 4 2 4 8 2 4 6 4 6 4 6 8 6 4 2 4 6 4 6 4 2 2 2 4 4 2 4 6 4 2 0"
    assert indents == [int(n) for n in wanted.split()]


def test_what_does_not_parse_is_left_alone() -> None:
    with pytest.raises(Exception, match="P00"):
        lacuna.format_model("model M\n  Real x\nend M;\n")


def test_a_folder_is_formatted_beside_what_cannot_be(tmp_path: Path) -> None:
    """A file that is no UTF-8, or no Modelica, ended the command before those behind it."""
    (tmp_path / "A.mo").write_bytes(b"model A \xff end A;\n")
    (tmp_path / "B.mo").write_text("model B Real x = ; end B;\n")
    (tmp_path / "C.mo").write_text("model C\nReal x = 1;\nend C;\n")
    result = CliRunner().invoke(app, ["format", str(tmp_path)])
    assert result.exit_code == 1
    assert (tmp_path / "C.mo").read_text() == "model C\n  Real x = 1;\nend C;\n"
    assert "A.mo: not a text in UTF-8" in result.output and "B.mo:1:" in result.output
    assert "left as they are: 2 of 3 files" in result.output


def test_an_empty_name_is_not_the_present_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As of a variable that the shell has not set: every file below the present folder was formatted."""
    (tmp_path / "C.mo").write_text("model C\nReal x = 1;\nend C;\n")
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["format", ""])
    assert result.exit_code == 2 and "an empty name" in result.output
    assert (tmp_path / "C.mo").read_text() == "model C\nReal x = 1;\nend C;\n"


@pytest.mark.parametrize(
    "text",
    [
        'model A\n  Real \'a"b\' = 1;\n  constant String s = "line1\n     line2   \n   line3";\nend A;\n',
        "model B\n  Real x = 1; // note\u2028 Real y = 2;\n  Real z = 3; // page\f Real w = 4;\nend B;\n",
        "model C\n  constant String s = \"a\u2028b\f\v  d\";\n  Real 'x/*' = 1;\nend C;\n",
        'model D\r\n  Real x = 1; // c\r\n\r\n  constant String s = "a\r\n    b";\r\nend D;\r\n',
        "model R\n  Real x = 1; // off:\r Real y = 2;\nend R;\n",
        "model K /* from\n    here // */\n  Real x = 1; /* and\n       there */\nend K;\n",
    ],
)
def test_characters_that_others_take_for_the_end_of_a_line_are_none(text: str, tmp_path: Path) -> None:
    """They became line breaks, within comments and strings; a quote within a name began a string."""
    (tmp_path / "M.mo").write_bytes(text.encode())
    assert not lacuna.format_file(tmp_path / "M.mo")
    untidy = text.replace("\n  Real", "\n     Real")
    (tmp_path / "M.mo").write_bytes(untidy.encode())
    assert lacuna.format_file(tmp_path / "M.mo") and (tmp_path / "M.mo").read_bytes() == text.encode()
