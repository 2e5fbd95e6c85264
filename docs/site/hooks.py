"""What MkDocs calls while `make docs` builds the site: generated pages, notices of older numbers, links out of docs/.

`LACUNA_DOCS_FIGURES=N` draws only the first N responses of the catalogue; LACUNA_DOCS_CACHE keeps the drawn ones.
"""

from __future__ import annotations

import os
from pathlib import Path
import re
import sys

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from docs.site import api, catalogue, notebooks, provenance  # noqa: E402
from docs.site.responses import Drawer  # noqa: E402
from tests.proof.runner import tool_hash  # noqa: E402

VERSION = (ROOT / "VERSION").read_text(encoding="utf-8").strip()
OUTSIDE = {"README.md": "tour.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
CACHE = Path(os.environ.get("LACUNA_DOCS_CACHE", ROOT / "build" / "docs"))


def on_config(config):
    """The navigation's `...` stands for what is generated, or for the rest of a folder."""
    every = sorted(path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.md"))
    rest = {
        "Notebooks": [f"notebooks/{stem}.md" for stem in notebooks.stems()],
        "Components": [name for name in every if name.startswith("components/") and not name.endswith("README.md")],
        "Catalogue": ["catalogue/index.md", *(f"catalogue/{name}.md" for name in catalogue.names())],
        "Project": [name for name in every if re.match(r"decisions/\d", name)],
    }
    for entry in config.nav:
        for title, pages in entry.items():
            if title in rest:
                at = pages.index("...")
                pages[at : at + 1] = rest[title]
    return config


def on_files(files: Files, config) -> Files:
    wrong = provenance.faults(written_pages())
    if wrong:
        raise PluginError("\n".join(wrong))
    made = {f"site/{name}": _outside(source) for source, name in OUTSIDE.items()}
    made["site/licence.md"] = f"# Licence\n\n```text\n{(ROOT / 'LICENSE').read_text(encoding='utf-8')}```\n"
    made["site/api.md"] = api.page()
    made |= {f"notebooks/{stem}.md": notebooks.page(stem) for stem in notebooks.stems()}
    limit = os.environ.get("LACUNA_DOCS_FIGURES")
    drawer = Drawer(CACHE, None if limit is None else int(limit))
    made |= {f"catalogue/{name}": content for name, content in catalogue.pages(drawer).items()}
    for name, content in made.items():
        files.append(File.generated(config, name, content=content))
    return files


def written_pages() -> dict[str, str]:
    """Every page that is written down, by its path from the root."""
    paths = [*(ROOT / "docs").rglob("*.md"), *(ROOT / name for name in OUTSIDE)]
    return {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in paths}


def _outside(source: str) -> str:
    """A page of the repository's root as one in docs/site/: its links follow."""
    text = (ROOT / source).read_text(encoding="utf-8")
    text = re.sub(r"\]\(docs/", "](../", text)
    return re.sub(r"\]\((\w+\.md|LICENSE)\)", lambda m: f"]({OUTSIDE.get(m[1], 'licence.md')})", text)


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    name = page.file.src_uri
    markdown = re.sub(r"\]\((?:\.\./)+LICENSE\)", "](site/licence.md)", markdown)
    markdown = re.sub(r"\]\(([\w-]+)\.ipynb\)", r"](\1.md)", markdown)
    if "command" in page.meta:
        entries = {key: str(page.meta[key]) for key in ("command", "version", "state") if key in page.meta}
        head, _, rest = markdown.lstrip().partition("\n")
        if not head.startswith("# "):
            raise PluginError(f"{name}: a page begins with its title")
        return f"{head}\n\n{provenance.banner(provenance.Origin(**entries), VERSION, tool_hash)}{rest}"
    return markdown
