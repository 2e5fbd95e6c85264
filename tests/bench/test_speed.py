"""The page of times: what it holds is what was measured, and the README repeats no number that is not on it."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from bench.speed import PAGE, WRITTEN, page
from docs.site.provenance import faults, origin

README = Path(__file__).parents[2] / "README.md"
NUMBERS = [
    ("x", 0.38412, "0.38"),
    ("y", 5.28e-7, "5.3e-7"),
    ("z", 162.4, "162"),
    ("n", 10_000, "10000"),
    ("o", None, ""),
]


@pytest.mark.parametrize(("text", "number", "written"), NUMBERS)
def test_each_row_is_there_by_two_digits(text: str, number: float | None, written: str) -> None:
    measured = {name: [dict.fromkeys(columns, number) | {columns[0]: text}] for name, (_, columns) in WRITTEN.items()}
    rows = [line for line in page(measured).splitlines() if line.startswith(f"| {text} |")]
    expected = [f"| {' | '.join([text, *[written] * (len(columns) - 1)])} |" for _, columns in WRITTEN.values()]
    assert rows == expected


def test_the_readme_has_its_times_from_the_page() -> None:
    readme, times = README.read_text(encoding="utf-8"), PAGE.read_text(encoding="utf-8")
    found = origin(times)
    assert found is not None and found.command == "make speed"
    marked = f"<!-- numbers: docs/speed.md {found.version} -->\n"
    assert readme.count(marked) >= 2
    assert faults({"README.md": readme, "docs/speed.md": times} | _others(readme)) == []
    wrong = re.sub(r"(\| generated, IDA \| )0\.\d+", r"\g<1>0.98765", readme)
    assert "README.md: 0.98765 is not on docs/speed.md" in faults(
        {"README.md": wrong, "docs/speed.md": times} | _others(readme)
    )


def _others(readme: str) -> dict[str, str]:
    """The other pages that it has numbers from."""
    names = set(re.findall(r"<!-- numbers: (\S+) ", readme)) - {"docs/speed.md"}
    return {name: (README.parent / name).read_text(encoding="utf-8") for name in names}
