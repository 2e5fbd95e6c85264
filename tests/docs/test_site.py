"""The documentation site: built without a warning, found by its search, and honest about the age of its numbers."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import threading

import pytest

pytest.importorskip("mkdocs", reason="the site needs the extra docs: make setup")
pytest.importorskip("mkdocstrings", reason="the site needs the extra docs: make setup")

from docs.site import catalogue, provenance
from docs.site.responses import Drawer
from lacuna.codegen.library.classes import Library

ROOT = Path(__file__).parents[2]
FIGURES = 8  # the catalogue's others are drawn by `make docs`


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site, with few figures. It is built strictly: a warning is an error."""
    out = tmp_path_factory.mktemp("site")
    environment = {**os.environ, "LACUNA_DOCS_FIGURES": str(FIGURES), "LACUNA_DOCS_CACHE": str(out / "cache")}
    command = [sys.executable, "-m", "mkdocs", "build", "--site-dir", str(out / "site")]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not re.search(r"^(WARNING|ERROR)", done.stderr, re.MULTILINE), done.stderr
    return out / "site"


@pytest.fixture(scope="module")
def address(site: Path) -> Iterator[str]:
    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(site))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()


def test_the_search_finds_pages_and_nothing_is_loaded_from_elsewhere(address: str, site: Path) -> None:
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("Chromium is not installed")
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    said: list[str] = []
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.on("console", lambda m: said.append(m.text) if m.type == "error" else None)
        page.on("request", lambda r: said.append(r.url) if not r.url.startswith((address, "data:", "blob:")) else None)
        page.goto(f"{address}/index.html")
        for word, expected in (("backlash", "catalogue/"), ("IDA", "residual-form"), ("severity", "assessment")):
            page.locator(".md-search__input").click()
            page.locator(".md-search__input").fill("")
            page.locator(".md-search__input").press_sequentially(word)
            page.wait_for_function(  # results of this word: each link carries it
                "w => document.querySelector('.md-search-result__link')?.href.toLowerCase().includes('h=' + w)",
                arg=word.lower(),
            )
            links = page.locator(".md-search-result__link").evaluate_all("all => all.map(a => a.href)")
            assert any(expected in link for link in links), (word, links)
        for width in (380, 1600):
            page.set_viewport_size({"width": width, "height": 900})
            for name in sorted(path.relative_to(site).as_posix() for path in site.rglob("*.html")):
                page.goto(f"{address}/{name}")
                assert page.evaluate("document.documentElement.scrollWidth") <= width + 1, (name, width)
        browser.close()
    assert said == []


def test_every_class_and_every_public_name_has_its_place(site: Path) -> None:
    import lacuna

    library = Library([ROOT / "model"])
    effects = (site / "catalogue/Effects.html").read_text(encoding="utf-8")
    for name in library.members(library.find("Lacuna.Effects")):
        assert f'id="{name.lower()}"' in effects or name == "Interfaces", name
    reference = (site / "site/api.html").read_text(encoding="utf-8")
    for name in lacuna.__all__:
        assert re.search(rf'id="lacuna\.\w+\.{name}"', reference), name
    assert 0 < len(list((site / "catalogue").glob("*.svg"))) <= FIGURES  # a flange that is fixed has none


def test_links_between_pages_lead_somewhere(site: Path) -> None:
    ids = {
        page.resolve(): set(re.findall(r'\bid="([^"]*)"', page.read_text(encoding="utf-8")))
        for page in site.rglob("*.html")
    }
    broken = []
    for page in ids:
        for link in re.findall(r'\b(?:href|src)="([^"#:?]*)(?:#([^"]*))?"', page.read_text(encoding="utf-8")):
            target = (page.parent / link[0]).resolve() if link[0] else page
            target = target / "index.html" if target.is_dir() else target
            if page.name != "404.html" and (
                not target.exists() or (link[1] and link[1] not in ids.get(target, {link[1]}))
            ):
                broken.append((page.name, link))
    assert broken == []


def test_older_pages_say_so_by_themselves(site: Path) -> None:
    version = (ROOT / "VERSION").read_text(encoding="utf-8").strip()
    pages = {p.stem: provenance.origin(p.read_text(encoding="utf-8")) for p in (ROOT / "docs").glob("*.md")}
    written = {name: origin for name, origin in pages.items() if origin is not None}
    assert {"proof", "robustness", "msl"} <= set(written)
    for name, origin in written.items():
        text = (site / f"{name}.html").read_text(encoding="utf-8")
        assert f"<code>{origin.command}</code>" in text, name
        assert origin.version == version or "the numbers were not measured again" in text, name


def test_the_notice_follows_version_and_state() -> None:
    found = provenance.Origin("make prove", "0.2.0", "abc")
    assert "Older numbers" not in provenance.banner(found, "0.2.0", lambda: "abc")
    assert "have changed since" in provenance.banner(found, "0.2.0", lambda: "abd")
    assert "of version 0.3.0: the numbers" in provenance.banner(found, "0.3.0", lambda: "abc")


PROOF = "---\ncommand: make prove\nversion: 0.2.0\nstate: abc\n---\n# Proof\n\n60 of 64 are right.\n"


@pytest.mark.parametrize(
    ("page", "fault"),
    [
        ("<!-- numbers: docs/proof.md abc -->\nIt named 60 of\n64.\n\nAnd 7.", ""),
        ("<!-- numbers: docs/proof.md abd -->\nIt named 60.", "numbers of docs/proof.md by abd, which is now by abc"),
        ("<!-- numbers: docs/proof.md abc -->\nIt named 61.", "61 is not on docs/proof.md"),
        ("<!-- numbers: docs/poof.md abc -->\nIt named 60.", "docs/poof.md, which is no page"),
        ("Written by `make prove`: 60 of 64.", "not in its first lines"),
        ("---\ncommand: make prove\n---\n60", "first lines"),
    ],
)
def test_a_number_of_another_version_is_refused(page: str, fault: str) -> None:
    found = provenance.faults({"README.md": page, "docs/proof.md": PROOF})
    assert [fault in text for text in found] == ([True] if fault else [])


def test_the_pages_of_the_repository_have_no_such_fault() -> None:
    from docs.site.hooks import written_pages

    assert provenance.faults(written_pages()) == []


def test_a_response_is_that_of_the_law(tmp_path: Path) -> None:
    """A spring moved by sin(t) against a fixed end: its figure says so, and it is kept."""
    library = Library([ROOT / "model"])
    part = catalogue.part(library, library.find("Lacuna.Components.Mechanics.Spring"))
    first = Drawer(tmp_path).response(part)
    assert "flange_a moved as sin(w t), the other flange fixed" in first.caption
    assert first.svg.startswith("<?xml")
    assert Drawer(tmp_path).response(part) == first
    assert len(list(tmp_path.iterdir())) == 1
    assert Drawer(tmp_path, limit=0).response(part) is None
