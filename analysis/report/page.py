"""The page that every report is: verdict and next action first, then what they rest on, then where it came from.

One file without outside references; readable at any width, in the dark and on paper. Everything is escaped by the
template unless it is Markup.
"""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
import gzip
import hashlib
import os
from pathlib import Path
import re
import shlex
import sys

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

import lacuna

_HERE = Path(__file__).parent
LONG = 200_000  # bytes of a figure's data: a page of many figures is still to be sent by mail
_BEFORE_UNIT = re.compile(r"(?<=\d) (?=(?:%|[munk\u00b5]?(?:[AVWsgmKN]|rad|Hz|Ohm)|\w+[./]\w+|\u00b0)(?![\w-])|\u00b1)")
_ASIDE = ("--out", "-o", "--jobs", "--scheduler", "--chunk", "--watch", "--port")
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
        title=title, body=body, verdict=unbroken(verdict), action=unbroken(action), files=files, notes=notes,
        script=Markup((_HERE / "page.js").read_text(encoding="utf-8")),
        style=Markup((_HERE / "page.css").read_text(encoding="utf-8")), version=lacuna.__version__,
        command=_command(sys.argv), made=_made(),
    )  # fmt: skip


def _command(words: Sequence[str]) -> str:
    """What was typed, without where the answer goes and what does the work: neither changes what a page says."""
    if Path(words[0]).name != "lacuna":
        return "import lacuna"
    kept, skip = ["lacuna"], False
    for word in words[1:]:
        name = word.split("=", 1)[0]
        if not skip and name not in _ASIDE:
            kept.append(word)
        skip = not skip and name in _ASIDE and "=" not in word
    return shlex.join(kept)


def _made() -> str:
    """The instant that SOURCE_DATE_EPOCH says; without it none, so that equal inputs give equal pages."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    return datetime.fromtimestamp(int(epoch), UTC).strftime(", %Y-%m-%d %H:%M UTC") if epoch.isdigit() else ""


def table(header: Sequence[object], rows: Iterable[Sequence[object]], numbers: range = range(1, 99)) -> Markup:
    """A table that scrolls in itself; columns in `numbers` stand at the right."""

    def line(tag: str, cells: Sequence[object]) -> Markup:
        marked = (
            Markup("<{0}{1}>{2}</{0}>").format(
                Markup(tag), Markup(" class=number" if k in numbers else ""), unbroken(cell)
            )
            for k, cell in enumerate(cells)
        )
        return Markup("<tr>{}</tr>").format(Markup("").join(marked))

    body = Markup("\n").join(line("td", row) for row in rows)
    return Markup(
        '<div class="wide" tabindex="0" role="region" aria-label="table"><table><thead>{}</thead>\n'
        "<tbody>{}</tbody></table></div>"
    ).format(line("th", header), body)


def code(text: str | Markup, label: str) -> Markup:
    """Text of a program, which scrolls in itself; `label` is for those who do not see it."""
    return Markup('<pre tabindex="0" role="region" aria-label="{}">{}</pre>').format(label, text)


def figure(svg: str, title: str, caption: str = "", data: tuple[str, str] | None = None) -> Markup:
    """An SVG in the page itself, with title and description for those who do not see it. `data`: the name and text of a
    file of what is drawn, to be kept by a link."""
    drawn = svg[svg.index("<svg") :]
    name = f"f{hashlib.sha256(drawn.encode()).hexdigest()[:10]}"
    drawn = re.sub(r'\b(id="|href="#|url\(#)', rf"\g<1>{name}-", drawn)  # several figures lie in one page
    head = Markup('<title id="{0}t">{1}</title><desc id="{0}d">{2}</desc>').format(name, title, caption or title)
    begin = drawn.index(">")
    drawn = f'{drawn[:begin]} role="img" aria-labelledby="{name}t {name}d">{head}{drawn[begin + 1 :]}'
    link = _download(*data) if data else Markup("")
    below = Markup("<figcaption>{} {}</figcaption>").format(caption, link) if caption or data else Markup("")
    return Markup('<figure><div class="wide" tabindex="0" role="region" aria-label="{}">{}</div>{}</figure>').format(
        title, Markup(drawn), below
    )


def figure_in(folder: Path, stem: str, title: str, caption: str = "") -> Markup:
    """The figure that lies in `folder` as <stem>.svg, with its data <stem>.csv."""
    svg, data = ((folder / f"{stem}.{kind}").read_text(encoding="utf-8") for kind in ("svg", "csv"))
    return figure(svg, title, caption, (f"{stem}.csv", data))


def _download(name: str, text: str) -> Markup:
    """A link that holds the file itself, packed where it is long."""
    raw, kind = text.encode(), "text/csv"
    if len(raw) > LONG:
        raw, kind, name = gzip.compress(raw, mtime=0), "application/gzip", f"{name}.gz"
    link = Markup('<a download="{}" href="data:{};base64,{}">the data as CSV</a>')
    return link.format(name, kind, base64.b64encode(raw).decode())


def heading(text: str) -> Markup:
    return Markup("<h2>{}</h2>").format(unbroken(text))


def unbroken(text: object) -> object:
    """Text in which no line ends between a number and its unit or its error; Markup is left as it is."""
    if type(text) is not str:
        return text
    return _BEFORE_UNIT.sub("\N{NO-BREAK SPACE}", text).replace("\u00b1 ", "\u00b1\N{NO-BREAK SPACE}")


def paragraph(text: str) -> Markup:
    return Markup("<p>{}</p>").format(escape(text))
