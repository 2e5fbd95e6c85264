"""Save an equation, see the figure change: a page on this machine alone that follows the sources of a model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
import io
import json
from pathlib import Path
import secrets
import threading
import time
from typing import TYPE_CHECKING

from lacuna.codegen.library.search_path import MODEL_FOLDER
from lacuna.drawn import save
from lacuna.errors import is_user_error, message_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LOOK = 0.1  # s between two looks at the sources: little beside a translation, and not felt
PATIENCE = 20  # s that a page's question waits for something new: shorter than any proxy's
_PAGE = Path(__file__).with_name("watching.html")


def watch(
    draw: Callable[[], Figure | Iterable[Figure]],
    sources: Iterable[str | Path],
    *,
    title: str = "",
    port: int = 0,
    opened: Callable[[str], None] = print,
    told: Callable[[str], None] = print,
    stop: threading.Event | None = None,
) -> None:
    """Serve a page with the figure that `draw` gives, and draw it again whenever one of `sources` changes.

    Of several figures each takes the place of the one before; those still to come are left out where a source changes
    meanwhile. `sources` are .mo files or other files, and folders of .mo files; those of package Lacuna are looked at,
    too. What `draw` raises because of a user's mistake stands on the page, above the last figure. The page is at an
    address with a secret, which `opened` is told, and answers to this machine only; `port` 0 takes a free one. `told`
    hears what was drawn, and how long after the save. Ends when `stop` is set, or by KeyboardInterrupt.
    """
    shown = _Shown(title)
    server = ThreadingHTTPServer(("127.0.0.1", port), _handler(shown))
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    opened(f"http://127.0.0.1:{server.server_address[1]}/{shown.secret}/")
    try:
        _follow(draw, [*map(Path, sources), MODEL_FOLDER], shown, told, stop or threading.Event())
    finally:
        shown.close()
        server.shutdown()
        server.server_close()


def _follow(
    draw: Callable[[], Figure | Iterable[Figure]],
    sources: list[Path],
    shown: _Shown,
    told: Callable[[str], None],
    stop: threading.Event,
) -> None:
    seen: dict[Path, tuple[int, int]] = {}
    while not stop.is_set():
        found = _stamps(sources)
        stop.wait(LOOK)
        # A save is over when a second look sees no more of it: an editor empties a file before it writes it.
        if found == seen or _stamps(sources) != found:
            continue
        saved = max((stamp[0] for path, stamp in found.items() if seen.get(path) != stamp), default=0) / 1e9
        first, seen = not seen, found
        try:
            for figure in _figures(draw()):
                shown.change(_svg(figure), "")
                told("drawn" if first else f"drawn {time.time() - saved:.1f} s after the save")
                if stop.is_set() or _stamps(sources) != seen:
                    break
        except Exception as error:
            if not is_user_error(error):
                raise
            if _stamps(sources) != seen:  # it may be of a save that was read halfway
                continue
            shown.change(None, message_of(error))
            told(message_of(error))


def _figures(drawn: Figure | Iterable[Figure]) -> Iterable[Figure]:
    return drawn if isinstance(drawn, Iterable) else (drawn,)


def _svg(figure: Figure) -> str:
    buffer = io.StringIO()
    save(figure, buffer, "svg")
    text = buffer.getvalue()
    return text[text.index("<svg") :]


def _stamps(sources: Iterable[Path]) -> dict[Path, tuple[int, int]]:
    """When each file was last changed (ns), and its size; a file that goes meanwhile is not there."""
    found = {}
    for source in sources:
        for path in source.rglob("*.mo") if source.is_dir() else (source,):
            try:
                status = path.stat()
            except OSError:
                continue
            found[path] = (status.st_mtime_ns, status.st_size)
    return found


@dataclass
class _State:
    number: int = 0
    svg: str = ""
    message: str = ""


class _Shown:
    """What the page shows, by its number; askers wait for a number beyond theirs."""

    def __init__(self, title: str) -> None:
        self.secret = secrets.token_urlsafe(16)
        self.page = _PAGE.read_text(encoding="utf-8").replace("TITLE", escape(title))
        self._state, self._news, self._closed = _State(), threading.Condition(), False

    def change(self, svg: str | None, message: str) -> None:
        """`svg` None keeps the figure that was there."""
        with self._news:
            old = self._state
            self._state = _State(old.number + 1, old.svg if svg is None else svg, message)
            self._news.notify_all()

    def close(self) -> None:
        with self._news:
            self._closed = True
            self._news.notify_all()

    def beyond(self, number: int) -> str:
        """The state as JSON, at once where it is newer than `number`, else when it is, or after PATIENCE."""
        with self._news:
            self._news.wait_for(lambda: self._closed or self._state.number > number, PATIENCE)
            return json.dumps(self._state.__dict__ | {"closed": self._closed})


def _handler(shown: _Shown) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            host = self.headers.get("Host", "").rpartition(":")[0]
            place, _, what = self.path.removeprefix("/").partition("/")
            known = secrets.compare_digest(place.encode(), shown.secret.encode())
            # Another name for this address is a page elsewhere that had it resolved to here.
            if host not in ("127.0.0.1", "localhost") or not known:
                self.send_error(404)
            elif what == "":
                self._answer("text/html; charset=utf-8", shown.page)
            elif what.isdecimal():
                self._answer("application/json", shown.beyond(int(what)))
            else:
                self.send_error(404)

        def _answer(self, kind: str, text: str) -> None:
            body = text.encode()
            self.send_response(200)
            headers = {"Content-Type": kind, "Content-Length": str(len(body)), "Cache-Control": "no-store",
                       "Referrer-Policy": "no-referrer", "X-Content-Type-Options": "nosniff",
                       "Content-Security-Policy": "default-src 'none'; script-src 'unsafe-inline'; "
                       "style-src 'unsafe-inline'; connect-src 'self'; img-src data:"}  # fmt: skip
            for name, value in headers.items():
                self.send_header(name, value)
            try:
                self.end_headers()
                self.wfile.write(body)
            except ConnectionError:  # the page was closed meanwhile
                self.close_connection = True

        def log_message(self, *_: object) -> None:
            """Nothing: the terminal is for what was drawn."""

    return Handler
