"""The page that every report is: verdict and next action first, then what they rest on, then where it came from.

One file without outside references; readable at any width, in the dark and on paper. Everything is escaped by the
template unless it is Markup.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
import hashlib
import os
from pathlib import Path
import re
import sys

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

import lacuna

_HERE = Path(__file__).parent
_SETTING = Environment(loader=FileSystemLoader(_HERE), autoescape=True, undefined=StrictUndefined, trim_blocks=True)


def page(
    title: str,
    body: Markup,
    *,
    verdict: str = "",
    action: str = "",
    inputs: Iterable[Path] = (),
    notes: Sequence[str] = (),
) -> str:
    """The HTML of a report. `verdict` is one sentence, `action` what to do next; `inputs` are files that decided it, of
    which the page says the SHA-256; `notes` are further lines of where it came from."""
    files = [(path.name, hashlib.sha256(path.read_bytes()).hexdigest()) for path in inputs if path.is_file()]
    return _SETTING.get_template("page.html").render(
        title=title, body=body, verdict=verdict, action=action, files=files, notes=notes,
        style=Markup((_HERE / "page.css").read_text(encoding="utf-8")), version=lacuna.__version__,
        command=" ".join([Path(sys.argv[0]).name, *sys.argv[1:]]), made=_now().strftime("%Y-%m-%d %H:%M UTC"),
    )  # fmt: skip


def _now() -> datetime:
    """Now, or the instant that SOURCE_DATE_EPOCH says, so that a page can be made again to the same bytes."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    return datetime.fromtimestamp(int(epoch), UTC) if epoch.isdigit() else datetime.now(UTC)


def table(header: Sequence[object], rows: Iterable[Sequence[object]], numbers: range = range(1, 99)) -> Markup:
    """A table that scrolls in itself; columns in `numbers` stand at the right."""

    def line(tag: str, cells: Sequence[object]) -> Markup:
        marked = (
            Markup("<{0}{1}>{2}</{0}>").format(Markup(tag), Markup(" class=number" if k in numbers else ""), cell)
            for k, cell in enumerate(cells)
        )
        return Markup("<tr>{}</tr>").format(Markup("").join(marked))

    body = Markup("\n").join(line("td", row) for row in rows)
    return Markup(
        '<div class="wide" tabindex="0" role="region" aria-label="table"><table><thead>{}</thead>\n'
        "<tbody>{}</tbody></table></div>"
    ).format(line("th", header), body)


def figure(svg: str, title: str, caption: str = "", data: tuple[str, str] | None = None) -> Markup:
    """An SVG in the page itself, with title and description for those who do not see it. `data`: the name and text of a
    file of what is drawn, to be kept by a link."""
    drawn = svg[svg.index("<svg") :]
    name = f"f{hashlib.sha256(drawn.encode()).hexdigest()[:10]}"
    drawn = re.sub(r'\b(id="|href="#|url\(#)', rf"\g<1>{name}-", drawn)  # several figures lie in one page
    head = Markup('<title id="{0}t">{1}</title><desc id="{0}d">{2}</desc>').format(name, title, caption or title)
    drawn = re.sub(r"<svg([^>]*)>", rf'<svg\1 role="img" aria-labelledby="{name}t {name}d">{head}', drawn, count=1)
    link = _download(*data) if data else Markup("")
    below = Markup("<figcaption>{} {}</figcaption>").format(caption, link) if caption or data else Markup("")
    return Markup("<figure>{}{}</figure>").format(Markup(drawn), below)


def _download(name: str, text: str) -> Markup:
    import base64

    coded = base64.b64encode(text.encode()).decode()
    return Markup('<a download="{}" href="data:text/csv;base64,{}">the data as CSV</a>').format(name, coded)


def heading(text: str) -> Markup:
    return Markup("<h2>{}</h2>").format(text)


def paragraph(text: str) -> Markup:
    return Markup("<p>{}</p>").format(escape(text))
