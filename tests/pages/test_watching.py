"""The page of `--watch` in a real browser: what is saved is seen there, without a reload, and a slip above it."""

from __future__ import annotations

from collections.abc import Iterator
import json
from pathlib import Path
import shutil
import threading
import time
from typing import Any

import pytest

import lacuna
from tests.watched import MODEL, PATIENCE, written

CHROMIUM = shutil.which("chromium")
if CHROMIUM is None:
    pytest.skip("Chromium is not installed", allow_module_level=True)
playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")

pytestmark = pytest.mark.xdist_group("pages")


@pytest.fixture
def tank(tmp_path: Path) -> Path:
    return written(tmp_path)


@pytest.fixture
def address(tank: Path) -> Iterator[str]:
    heard, stop, ready = [], threading.Event(), threading.Event()

    def opened(place: str) -> None:
        heard.append(place)
        ready.set()

    def follow() -> None:
        lacuna.watch(lambda: lacuna.load(tank).simulate().plot(), [tank], title="Tank", opened=opened, stop=stop)

    watching = threading.Thread(target=follow)
    watching.start()
    ready.wait()
    yield heard[0]
    stop.set()
    watching.join()


def until_it_shows(page: Any, what: str) -> None:
    """(The page's own policy lets no text be evaluated in it, which waiting for a function would do.)"""
    end = time.monotonic() + PATIENCE
    while not page.evaluate(what):
        assert time.monotonic() < end, what
        time.sleep(0.05)


def test_what_is_saved_is_seen_in_the_browser(tank: Path, address: str, capfd: pytest.CaptureFixture[str]) -> None:
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page, said = browser.new_page(viewport={"width": 380, "height": 900}), []
        page.on("console", lambda message: said.append(message.text) if message.type in ("error", "warning") else None)
        page.goto(address)
        figure = "document.querySelector('#figure svg')?.outerHTML"
        until_it_shows(page, figure)
        before = page.evaluate(figure)
        tank.write_text(MODEL.replace("-h;", "-2*h;"), encoding="utf-8")
        until_it_shows(page, f"{figure} !== {json.dumps(before)}")
        after = page.evaluate(figure)
        tank.write_text(MODEL.replace("-h;", "-hh;"), encoding="utf-8")
        until_it_shows(page, "document.querySelector('#message').textContent.includes('did you mean h?')")
        assert page.evaluate(figure) == after  # the last figure stays, faded
        assert page.evaluate("getComputedStyle(document.querySelector('#figure')).opacity") == "0.4"
        assert page.evaluate("document.documentElement.scrollWidth") <= 381
        assert said == []
        page.screenshot(path=tank.with_suffix(".png"))
        browser.close()
    tank.write_text(MODEL, encoding="utf-8")  # an answer to a page that has gone
    time.sleep(3)
    assert "Traceback" not in capfd.readouterr().err
