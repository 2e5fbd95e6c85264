"""Every block of code in the documentation is of a kind that something checks; commands have the options shown."""

from __future__ import annotations

from pathlib import Path
import re
import shlex
import tomllib

import click
import pytest
import typer

from lacuna.cli.main import app
from lacuna.codegen.syntax import parse

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
# Pages whose Python runs in a test: the first two have one of their own, the others run below.
ELSEWHERE, HERE = {"docs/guide/README.md", "docs/python.md"}, ("docs/sensitivities.md", "docs/fmi.md")
KINDS = {"python", "modelica", "toml", "csv", "text", "diff", ""}
COMMAND = re.compile(r"^    (?:\$ )?(?:sudo )?lacuna (.+)$", re.MULTILINE)


def blocks(page: Path) -> list[tuple[str, str]]:
    return re.findall(r"^```(\w*)\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_every_block_is_of_a_checked_kind(page: Path) -> None:
    for kind, text in blocks(page):
        assert kind in KINDS, kind
        if kind == "python":
            compile(text, str(page), "exec")
            assert str(page.relative_to(ROOT)) in {*ELSEWHERE, *HERE}
        elif kind == "toml":
            tomllib.loads(text)
        elif kind == "modelica" and re.match(
            r"\s*(within|partial|model|block|package|function|record|connector)", text
        ):
            parse(text, str(page))


@pytest.mark.parametrize("page", HERE)
def test_its_python_runs(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for kind, text in blocks(ROOT / page):
        if kind == "python":
            exec(text, names)


def commands() -> list[tuple[str, str]]:
    found = []
    for page in PAGES:
        for line in COMMAND.findall(page.read_text(encoding="utf-8")):
            for part in re.split(r"\s+&&\s+|\s+\|\s+", line.partition(" #")[0]):
                found.append((str(page.relative_to(ROOT)), part.strip().removeprefix("lacuna ")))
    return found


@pytest.mark.parametrize(("page", "line"), commands())
def test_a_command_has_the_options_that_the_page_shows(page: str, line: str) -> None:
    words = shlex.split(line)
    command: click.Command = typer.main.get_command(app)
    while isinstance(command, click.Group) and words and not words[0].startswith("-"):
        name = words.pop(0)
        assert name in command.commands, f"{page}: lacuna has no command {name}"
        command = command.commands[name]
    context = click.Context(command, info_name=command.name)
    command.make_parser(context).parse_args(list(words))  # raises for an option that is not there


def test_there_are_commands_to_look_at() -> None:
    assert len(commands()) >= 30
