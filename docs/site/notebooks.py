"""Notebooks as pages, with what their cells showed when they were last executed; the tests execute them."""

from __future__ import annotations

import json
from pathlib import Path
import re

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"


def stems() -> list[str]:
    return sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def page(stem: str) -> str:
    """The notebook as Markdown."""
    cells = json.loads((FOLDER / f"{stem}.ipynb").read_text(encoding="utf-8"))["cells"]
    return "\n\n".join(_cell(cell) for cell in cells) + "\n"


def _cell(cell: dict) -> str:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        return source
    return "\n\n".join([f"```python\n{source}\n```", *(_output(output) for output in cell.get("outputs", []))])


def _output(output: dict) -> str:
    if "text" in output:
        return f"```text\n{''.join(output['text']).rstrip()}\n```"
    data = output.get("data", {})
    for kind in ("image/svg+xml", "text/html"):
        if kind in data:
            return _block("".join(data[kind]))
    return f"```text\n{''.join(data.get('text/plain', ''))}\n```"


def _block(markup: str) -> str:
    """HTML as one block of Markdown: an empty line would end it. Its own styles would be the page's."""
    markup = re.sub(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<style\b.*?</style>", "", markup, flags=re.DOTALL)
    lines = [line for line in markup.splitlines() if line.strip()]
    return "<div>\n" + "\n".join(lines) + "\n</div>"
