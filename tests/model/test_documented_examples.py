"""The models printed in docs/components/ are translated and run as printed."""

from __future__ import annotations

from pathlib import Path
import re

import numpy as np
import pytest

PAGES = Path(__file__).parents[2] / "docs" / "components"


def printed_model(page: str) -> str:
    return re.search(r"```modelica\n(.*?)```", (PAGES / page).read_text(encoding="utf-8"), re.DOTALL)[1]


def test_component(run) -> None:
    """At constant speed the heat is a lag of the friction's power: at first b w, and less and less."""
    component = printed_model("add-a-component.md").replace("within Lacuna.Components.Mechanics;\n", "")
    component = component.replace("Interfaces.", "Lacuna.Interfaces.").replace("Types.", "Lacuna.Types.")
    model = f"""
    model Test
      {component}
      Lacuna.Components.Mechanics.SpeedSource shaft;
      WarmingBearing bearing(b=2e-4);
    equation
      shaft.u = 100;
      connect(shaft.flange, bearing.flange_a);
    end Test;
    """.strip()
    result = run(model, stop=100.0, interval=1.0)
    assert result["bearing.tau"][0] == pytest.approx(0.02, rel=1e-9)
    assert np.all(np.diff(result["bearing.tau"]) < 0)
    E = result["bearing.E"][-1]
    assert result["bearing.tau"][-1] == pytest.approx(0.02 / (1 + E / 50), rel=1e-9)


def test_actuator(run) -> None:
    model = printed_model("add-an-actuator.md").replace("HeavySurface", "Test")
    result = run(model, rtol=1e-6)
    assert result["surface.phi"][-1] == pytest.approx(0.1, abs=2e-3)


@pytest.mark.parametrize("page", sorted(PAGES.glob("*.md")), ids=lambda p: p.stem)
def test_links_and_names_exist(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)]+)\)", text):
        assert (PAGES / target).exists(), target
    model = PAGES.parents[1] / "model"
    known = {f.stem for f in model.rglob("*.mo")} | {f.name for f in model.rglob("*") if f.is_dir()}
    for name in re.findall(r"\| `([A-Z][A-Za-z]+)`", text):
        assert name in known, name
