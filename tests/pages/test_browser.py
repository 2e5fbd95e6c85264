"""The pages in a real browser, Debian's Chromium: nothing on the console, nothing wider than the window, nothing
serious found by axe-core, tables and figures whole on paper."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import re
import shutil
from typing import Any

from markupsafe import Markup
import pytest

import lacuna
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.report.page import page, unbroken
from tests.analysis.plants import ReferencePlant, paper_settings
from tests.analysis.reference import simulate
from tests.analysis.test_assessment import COLUMNS, write

ROOT = Path(__file__).parents[2]
CHROMIUM = shutil.which("chromium")
if CHROMIUM is None:
    pytest.skip("Chromium is not installed", allow_module_level=True)
playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")

pytestmark = pytest.mark.xdist_group("pages")  # they are made once

WIDTHS = (380, 820, 1600)
BROKEN = """e => { const text = document.createRange(); text.selectNodeContents(e);
  return !e.textContent.includes(" ") && text.getClientRects().length > 1; }"""  # one number on two lines
VANISHED = 1  # px: rounding of a length
HISTORY = "actuator,cycles,severity,low,high,event\n" + "".join(
    f"A1,{k},{0.02 + 4e-5 * k},{0.01 + 4e-5 * k},{0.03 + 4e-5 * k},\nA<2>,{k},0.02,0.01,0.03,\n"
    for k in range(0, 3001, 300)
)


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory, map_folder: Path) -> dict[str, Path]:
    """Every kind of report that does not take minutes to make."""
    folder = tmp_path_factory.mktemp("pages")
    build_map(ReferencePlant(), paper_settings(folder, *COARSE), folder / "map")
    recorded = write(folder / "<test>.csv", simulate(0.2)[:3])
    lacuna.assess(recorded, map_folder, columns=COLUMNS, out=folder / "assess")
    lacuna.sweep(points=4, out=folder / "sweep")
    model = folder / "Small.mo"
    model.write_text(
        'model Small\n  Real x(start=1, fixed=true);\n  parameter Real k(unit="1/s") = 1;\nequation\n'
        "  der(x) = if x > 0.5 then -k*x else -2*k*x;\n  annotation(experiment(StopTime=1, Interval=0.01));\n"
        "end Small;\n",
        encoding="utf-8",
    )
    lacuna.compare(model, out=folder / "compare")
    (folder / "history.csv").write_text(HISTORY, encoding="utf-8")
    lacuna.forecast(folder / "history.csv", out=folder / "forecast")
    examples = {path.name: path for path in lacuna.copy_examples(folder / "examples")}
    case = lacuna.open_case(examples["missing-physics"])
    case.judge(ROOT / "model/Benches/DcServo.mo", out=folder / "judge")
    lacuna.explain(examples["missing-physics"], out=folder / "explain", limit=8)  # it says what it knows by then
    lacuna.fleet(folder / "history.csv", out=folder / "fleet")
    return {name: folder / name / ("fleet.html" if name == "fleet" else "report.html") for name in NAMES}


COARSE = [("step = 0.01", "step = 0.1")]
NAMES = ("map", "assess", "sweep", "compare", "forecast", "fleet", "explain", "judge")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as started:
        running = started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield running
        running.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", NAMES)
def test_nothing_overflows_and_nothing_is_said_on_the_console(
    pages: dict[str, Path], browser: Any, name: str, width: int, scheme: str
) -> None:
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page, said = context.new_page(), []
    page.on("console", lambda message: said.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: said.append(request.url) if request.url.startswith("http") else None)
    page.goto(pages[name].as_uri())
    assert page.evaluate("document.documentElement.scrollWidth") <= width + VANISHED
    assert said == []
    context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", NAMES)
def test_axe_finds_nothing_serious(pages: dict[str, Path], browser: Any, name: str, scheme: str) -> None:
    context = browser.new_context(color_scheme=scheme)
    page = context.new_page()
    page.goto(pages[name].as_uri())
    found = axe.Axe().run(page).response["violations"]
    grave = [(v["id"], v["nodes"][0]["html"][:200]) for v in found if v["impact"] in ("serious", "critical")]
    assert grave == []
    context.close()


@pytest.mark.parametrize("name", NAMES)
def test_on_paper_no_table_is_cut(pages: dict[str, Path], browser: Any, name: str) -> None:
    """At the width of A4 less its margins, 180 mm at 96 dots an inch."""
    width = round(180 / 25.4 * 96)
    context = browser.new_context(viewport={"width": width, "height": 1000})
    page = context.new_page()
    page.goto(pages[name].as_uri())
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")  # as the browser says before it prints
    assert page.evaluate("[...document.querySelectorAll('details')].every(e => e.open)")
    wide = "e => e.getBoundingClientRect().right > innerWidth + 1"
    cut = f"[...document.querySelectorAll('table, figure, pre')].filter({wide})"
    assert page.evaluate(f"{cut}.map(e => e.outerHTML.slice(0, 200))") == []
    broken = f"[...document.querySelectorAll('td.number')].filter({BROKEN}).map(e => e.textContent)"
    assert page.evaluate(broken) == []
    sizes = "['h2', 'p:not([class])', 'td'].map(s => document.querySelector('main ' + s)).filter(e => e)"
    found = page.evaluate(f"{sizes}.map(e => parseFloat(getComputedStyle(e).fontSize))")
    assert max(found) < 1.5 * min(found)  # headings and tables shrink with the text
    assert page.pdf(format="A4").startswith(b"%PDF")
    context.close()


@pytest.mark.parametrize("name", NAMES)
def test_the_verdict_comes_first_and_the_page_says_where_it_comes_from(pages: dict[str, Path], name: str) -> None:
    text = pages[name].read_text(encoding="utf-8")
    body = text[text.index("<main>") :]
    first = min(body.index("<figure"), (body + "<table").index("<table"))
    assert body.index('class="verdict"') < body.index('class="action"') < first
    assert f"Lacuna {lacuna.__version__}" in text and "Made by <code>" in text
    assert "prefers-color-scheme: dark" in text and "@media print" in text


@pytest.mark.parametrize("name", [name for name in NAMES if name != "compare"])  # which tells how long runs took
def test_a_page_says_nothing_of_the_instant_or_the_place_where_it_was_made(pages: dict[str, Path], name: str) -> None:
    text = pages[name].read_text(encoding="utf-8")
    assert str(pages[name].parents[1]) not in text
    assert not re.search(r"\b20\d\d-\d\d-\d\d\b", text)


def test_a_page_bears_the_date_that_it_is_given(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1796083200")
    assert ", 2026-12-01 00:00 UTC. Made by" in page("Title", Markup(""))


def test_a_figure_is_enlarged_by_dragging_and_whole_again_by_its_button(pages: dict[str, Path], browser: Any) -> None:
    page = browser.new_page(viewport={"width": 1200, "height": 900})
    page.goto(pages["explain"].as_uri())
    svg = page.locator("figure svg").first
    svg.scroll_into_view_if_needed()
    whole, box = svg.get_attribute("viewBox"), svg.bounding_box()
    page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.25 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.up()
    left, top, width, height = map(float, svg.get_attribute("viewBox").split())
    of = [float(x) for x in whole.split()]
    shares = [left / of[2], top / of[3], width / of[2], height / of[3]]
    assert shares == pytest.approx([0.25] * 4, abs=0.01)
    assert svg.bounding_box()["height"] == pytest.approx(box["height"], abs=1)  # the page does not jump
    page.get_by_role("button", name="whole figure").first.click()
    assert svg.get_attribute("viewBox") == whole
    page.close()


def test_no_word_of_the_wall_lies_on_another(pages: dict[str, Path], browser: Any) -> None:
    page = browser.new_page(viewport={"width": 1600, "height": 900})
    page.goto(pages["fleet"].as_uri())
    words = page.evaluate("""[...document.querySelectorAll('figure svg text')].map(e => {
        const b = e.getBoundingClientRect(); return [e.textContent, b.left, b.right, b.top, b.bottom]; })""")
    on_another = [
        (a[0], b[0]) for k, a in enumerate(words) for b in words[:k]
        if a[1] < b[2] and b[1] < a[2] and (a[3] + a[4]) / 2 < b[4] and b[3] < (a[3] + a[4]) / 2
    ]  # fmt: skip
    assert words and on_another == []
    page.close()


def test_no_line_ends_between_a_number_and_its_unit_or_error() -> None:
    for text in ("22.2 % sure", "693.3 mA", "2e-05 m3/s", "1.2 kg.m2", "0.1 s", "3 \u00b1 0.1 N.m"):
        assert " " not in unbroken(text.partition(" sure")[0]), text
    assert unbroken("2 of 4 actuators, 3 steps") == "2 of 4 actuators, 3 steps"
    assert unbroken(Markup("5 %")) == "5 %" and unbroken(7) == 7


def test_equal_inputs_give_equal_bytes(pages: dict[str, Path], map_folder: Path, tmp_path: Path) -> None:
    root = pages["map"].parents[1]
    build_map(ReferencePlant(), paper_settings(tmp_path, *COARSE), tmp_path / "map", jobs=1)
    lacuna.assess(root / "<test>.csv", map_folder, columns=COLUMNS, out=tmp_path / "assess")
    lacuna.forecast(root / "history.csv", out=tmp_path / "forecast")
    lacuna.fleet(root / "history.csv", out=tmp_path / "fleet")
    lacuna.sweep(points=4, out=tmp_path / "sweep", chunk=1)
    for name in ("map", "assess", "forecast", "fleet", "sweep"):
        again = tmp_path / name / pages[name].name
        assert again.read_bytes() == pages[name].read_bytes(), name


def test_every_figure_has_a_title_and_words_and_its_data(pages: dict[str, Path]) -> None:
    for name in NAMES:
        figures = re.findall(r"<figure.*?</figure>", pages[name].read_text(encoding="utf-8"), re.DOTALL)
        assert figures, name
        for figure in figures:
            assert re.search(r"<svg[^>]*role=\"img\"", figure) and "<title" in figure and "<desc" in figure, name
            assert "download=" in figure, (name, re.search(r"<title[^>]*>([^<]*)", figure)[1])


def test_what_is_read_of_a_forecast_at_a_glance(pages: dict[str, Path]) -> None:
    """Thousands do not break over lines, a limit that is behind is said to be, tables name their units."""
    text = pages["forecast"].read_text(encoding="utf-8")
    body = re.sub(r"<svg.*?</svg>|base64,[^\"]*", "", text[text.index("<main>") :], flags=re.DOTALL)
    assert re.search("\\d\N{NO-BREAK SPACE}\\d{3} cycles", body) and not re.search(r"\d \d{3}\b", body)
    assert (
        "<td class=number>reached</td>" in body
        and "cycles until it" in body
        and "80\N{NO-BREAK SPACE}% sure: from" in body
    )
    assert "severity  (%)" in text and "orange from 11 %" in text and "A1 is the first to be removed" in body
    fleet = pages["fleet"].read_text(encoding="utf-8")
    assert re.search(r">A1, 14 %<", fleet) and "history.csv: <code>" in fleet and "history.csv: <code>" in text
    sweep = pages["sweep"].read_text(encoding="utf-8")
    for name, unit in (("Ke", "V.s/rad"), ("rms_mean", "A"), ("speed_mean", "rad/s")):
        assert f"<td>{name}</td><td>{unit}</td>" in sweep


@pytest.mark.parametrize("top", [1.0, 7.3, 2130.0, 99000.0])
def test_the_axis_of_a_fleet_has_round_numbers(top: float) -> None:
    from lacuna.analysis.prognosis.pages.overview import _round

    step = _round(top)
    assert 0.4 * top < step <= top and float(f"{step:.0e}") == pytest.approx(step)
