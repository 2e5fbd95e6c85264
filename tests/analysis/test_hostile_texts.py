"""Texts of users in reports and figures: whatever they hold, they are shown as they are."""

from __future__ import annotations

import io

import numpy as np
import pytest

from lacuna.analysis.report.figures.style import in_style, new_figure
from lacuna.analysis.report.page import figure
from lacuna.drawn import save
from lacuna.notebook import verbatim

NAMES = ["A/B\\C", "A\\1", "\\g<0>", "A$x_{$", "$\\frac{1}{$", "a_$\\alpha$", "<b>&\"'"]


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_draws_a_name_wherever_it_stands(name: str) -> None:
    with in_style():
        drawn = new_figure()
        axes, log = drawn.subplots(2)
        axes.plot([0, 1], [0, 1], label=name)
        axes.set_title(name)  # of the style, at the left
        axes.set_title(name, loc="right")
        axes.set_xlabel(name)
        axes.set_xticks([0, 1], [name, name])
        axes.annotate(name, (0.5, 0.5))
        axes.legend(title=name)
        log.loglog(*2 * [np.logspace(-3, 3)])
        drawn.suptitle(name)
        drawn.legend()
        target = io.StringIO()
        save(drawn, target, "svg")
    written = target.getvalue()
    wanted = name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    assert written.count(f"<!-- {wanted} -->") >= 9
    assert "<!-- $\\mathdefault{10^{-3}}$ -->" in written  # a power, which matplotlib sets


@pytest.mark.parametrize("name", NAMES)
def test_a_page_has_a_name_as_it_is(name: str) -> None:
    page = str(figure('<?xml version="1.0"?><svg width="1" id="a"><path d="M0"/></svg>', name))
    escaped = name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&#34;")
    escaped = escaped.replace("'", "&#39;")
    assert f'">{escaped}</title>' in page and f'">{escaped}</desc>' in page
    assert '<svg width="1" id="' in page and page.count("<path") == 1


def test_a_notebook_has_the_line_of_a_finding_as_it_is() -> None:
    assert verbatim("if a < b & c") == "<pre>if a &lt; b &amp; c</pre>"
