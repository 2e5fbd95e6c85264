"""The language server, driven by a real client: forty edits with what it says of each, and every question."""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
import pytest

from bench.editor import Editor, drive
from lacuna.codegen.library.search_path import MODEL_FOLDER
from lacuna.lsp.features import Workspace

MODEL = """\
model Winch "A motor that lifts a load"
  import Lacuna.Types;
  parameter Real R(unit="Ohm") = 2 "Resistance";
  parameter Real K(unit="N.m/A") = 0.05 "Torque constant";
  parameter Real J(unit="kg.m2", min=0) = 1e-3 "Inertia";
  parameter Integer n = 2 "Turns";
  input Real u(unit="V") "Voltage";
  Real i(unit="A") "Current";
  Real w(unit="rad/s", start=0, fixed=true) "Speed";
  output Real a(unit="rad/s2") "Acceleration";
  Real x[3](each unit="1") "Three of a kind";
  Boolean fast(start=false, fixed=true);
equation
  u = R*i + K*w;
  J*der(w) = K*i;
  a = der(w);
  for k in 1:3 loop
    x[k] = k*n;
  end for;
  when w > 10 then
    fast = true;
  end when;
end Winch;
"""
# What is replaced by what in the text, and the code that the server then finds, "" for none.
EDITS = [
    ("R*i + K*w", "R*j + K*w", "R002"),
    ("R*i + K*w", "R*i + K*w)", "P003"),
    ("R*i + K*w", "R*i ++ K*w", "P016"),
    ("R*i + K*w;", "R*i + K*w", "P006"),
    ("R*i + K*w", "R*i + w", "U002"),
    ("R*i + K*w", "R*i + K*W", "R002"),
    ("J*der(w) = K*i", "J*der(w) = K*i*w", "U001"),
    ("J*der(w) = K*i", "J*dre(w) = K*i", "R004"),
    ("end Winch", "end Winsh", "P005"),
    ("model Winch", "modle Winch", "P003"),
    ("Real i(unit", "Reel i(unit", "R001"),
    ('Real i(unit="A")', 'Real i(unit="A//s")', "U005"),
    ('Real i(unit="A")', 'Real i(unit="Ampere")', "W015"),
    ('Real i(unit="A")', 'Real i(unti="A")', "R035"),
    ("Real i(unit", "Real w(unit", "R010"),
    ("parameter Integer n = 2", "parameter Integer n = 2.5", "R024"),
    ("parameter Integer n = 2", "parameter Integer n = m", "R002"),
    ('"Inertia"', '"Inertia', "P002"),
    ("min=0", "min=0, min=1", "R030"),
    ("a = der(w);", "", ""),
    ("a = der(w);", "a = der(w);\n  a = 2*der(w);", ""),
    ("1:3", "1:4", "R045"),
    ("x[k]", "x[k,1]", "R044"),
    ("x[k]", "x", "R042"),
    ("end for;", "", "P009"),
    ("fast = true", "fast = 1", "R024"),
    ("fast = true", "fats = true", "R002"),
    ("when w > 10", "when w", "R020"),
    ("w > 10", "w >= u", "U002"),
    ("import Lacuna.Types;", "import Lacuna.Typse;", "R002"),
    ("import Lacuna.Types;", "import Lacuna.Types", "P006"),
    ("equation\n", 'equation\n  assert(w < 5, "too fast");\n', ""),
    ("equation\n", 'equation\n  assert(w, "too fast");\n', "R020"),
    ("equation\n", "equation\n  R = 3;\n", ""),
    ("equation\n", "algorithm\n", "P004"),
    ("a = der(w);", "a := der(w);", "P004"),
    ("a = der(w);", "a = sin(w, w);", "R050"),
    ("a = der(w);", "a = sni(w)*1;", "R004"),
    ("a = der(w);", "connect(u, w);", "R061"),
    ("a = der(w);", "a = if fast then 1 else true;", "R021"),
    ("a = der(w);", "a = der(w) /* ", "P002"),
    ("  Boolean fast", "  Types.Inertai m = 2;\n  Boolean fast", "R001"),
    ("u = R*i", "u # R*i", "P010"),
    ("0.05", "0.05x", "P011"),
]


def test_forty_edits_and_what_is_found_of_each(tmp_path: Path) -> None:
    assert len(EDITS) >= 40

    async def script(editor: Editor) -> None:
        assert await editor.open(MODEL) == []
        for old, new, code in EDITS:
            assert old in MODEL
            found = await editor.type(MODEL.replace(old, new, 1))
            assert [d.code for d in found] == ([code] if code else []), (old, new, found)
            for diagnostic in found:  # the marked place is where the edit was, or the line after it
                line = MODEL.count("\n", 0, MODEL.index(old))
                assert 0 <= diagnostic.range.start.line <= len(editor.text.split("\n")), (old, line)
                assert diagnostic.range.end.character > diagnostic.range.start.character
        assert await editor.type(MODEL) == []

    drive(tmp_path / "Winch.mo", script)


def test_what_is_marked_is_the_name_itself_and_a_quick_fix_mends_it(tmp_path: Path) -> None:
    async def script(editor: Editor) -> None:
        await editor.open(MODEL)
        (finding,) = await editor.type(MODEL.replace("fast = true", "fats = true"))
        line = editor.text.split("\n")[finding.range.start.line]
        assert line[finding.range.start.character : finding.range.end.character] == "fats"
        context = lsp.CodeActionContext([finding])
        document = lsp.TextDocumentIdentifier(editor.uri)
        (action,) = await editor.client.text_document_code_action_async(
            lsp.CodeActionParams(document, finding.range, context)
        )
        (edit,) = action.edit.changes[editor.uri]
        lines = editor.text.split("\n")
        start, end = edit.range.start.character, edit.range.end.character
        lines[edit.range.start.line] = line[:start] + edit.new_text + line[end:]
        assert "\n".join(lines) == MODEL
        assert await editor.type("\n".join(lines)) == []

    drive(tmp_path / "Winch.mo", script)


def test_hover_definition_references_and_rename(tmp_path: Path) -> None:
    async def script(editor: Editor) -> None:
        await editor.open(MODEL)
        hover = await editor.client.text_document_hover_async(lsp.HoverParams(**editor.place("u = R*|i")))
        assert "Current" in hover.contents.value and "`A`" in hover.contents.value
        hover = await editor.client.text_document_hover_async(lsp.HoverParams(**editor.place("J*der(|w)")))
        assert "J * der(w) = K * i" in hover.contents.value
        found = await editor.client.text_document_definition_async(lsp.DefinitionParams(**editor.place("u = |R*i")))
        assert editor.text.split("\n")[found.range.start.line].strip().startswith("parameter Real R")
        context = lsp.ReferenceContext(include_declaration=True)
        listed = await editor.client.text_document_references_async(
            lsp.ReferenceParams(context=context, **editor.place("J*der(|w)"))
        )
        assert len(listed) == 5
        renamed = await editor.client.text_document_rename_async(
            lsp.RenameParams(new_name="omega", **editor.place("J*der(|w)"))
        )
        lines = editor.text.split("\n")
        for edit in sorted(renamed.changes[editor.uri], key=lambda e: -e.range.start.character):
            at = edit.range.start
            lines[at.line] = lines[at.line][: at.character] + edit.new_text + lines[at.line][edit.range.end.character :]
        assert await editor.type("\n".join(lines)) == []
        assert "der(omega)" in editor.text and "Real omega(" in editor.text

    drive(tmp_path / "Winch.mo", script)


def test_a_new_name_that_is_none_is_refused(tmp_path: Path) -> None:
    async def script(editor: Editor) -> None:
        await editor.open(MODEL)
        for name in ("a b", "", "w = 1; end Winch", "1st", "'open", "end"):
            with pytest.raises(JsonRpcException, match="is not a name"):
                await editor.client.text_document_rename_async(
                    lsp.RenameParams(new_name=name, **editor.place("J*der(|w)"))
                )

    drive(tmp_path / "Winch.mo", script)


def test_questions_beyond_the_text_are_answered(tmp_path: Path) -> None:
    """As a client may ask that is an edit ahead of what the server has seen."""

    async def script(editor: Editor) -> None:
        await editor.open(MODEL)
        for place in (lsp.Position(10_000, 0), lsp.Position(0, 10_000)):
            at = {"text_document": lsp.TextDocumentIdentifier(editor.uri), "position": place}
            assert await editor.client.text_document_completion_async(lsp.CompletionParams(**at))
            assert await editor.client.text_document_hover_async(lsp.HoverParams(**at)) is None
        marked = lsp.Range(lsp.Position(10_000, 0), lsp.Position(10_000, 1))
        finding = lsp.Diagnostic(marked, "gone", data={"fixes": ["R"]})
        asked = lsp.CodeActionParams(lsp.TextDocumentIdentifier(editor.uri), marked, lsp.CodeActionContext([finding]))
        assert not await editor.client.text_document_code_action_async(asked)

    drive(tmp_path / "Winch.mo", script)


def test_names_of_a_library_are_found_and_completed(tmp_path: Path) -> None:
    text = (
        "model Stand\n  import Lacuna.Components.Mechanics;\n  Mechanics.Inertia load(J=1e-3);\nequation\n"
        "  load.flange_a.tau = 1;\n  load.flange_b.tau = 0;\nend Stand;\n"
    )

    async def script(editor: Editor) -> None:
        await editor.open(text)
        found = await editor.client.text_document_definition_async(
            lsp.DefinitionParams(**editor.place("Mechanics.|Inertia"))
        )
        assert found.uri.endswith("Mechanics/Inertia.mo")
        found = await editor.client.text_document_definition_async(lsp.DefinitionParams(**editor.place("load(|J=")))
        assert found.uri.endswith("Mechanics/Inertia.mo")
        await editor.type(text.replace("  load.flange_b", "  load.\n  load.flange_b"))
        items = await editor.client.text_document_completion_async(lsp.CompletionParams(**editor.place("  load.|\n")))
        assert {"J", "w", "flange_a"} <= {item.label for item in items}
        await editor.type(text.replace("load(J=1e-3)", 'load(J=1e-3);\n  Real x(unit="")'))
        items = await editor.client.text_document_completion_async(lsp.CompletionParams(**editor.place('unit="|"')))
        assert {"rad", "N", "Ohm"} <= {item.label for item in items}
        symbols = await editor.client.text_document_document_symbol_async(
            lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(editor.uri))
        )
        assert symbols[0].name == "Stand" and [c.name for c in symbols[0].children] == ["load", "x"]

    drive(tmp_path / "Stand.mo", script)


def test_a_file_that_is_open_counts_before_the_one_on_disk(tmp_path: Path) -> None:
    (tmp_path / "Stand.mo").write_text("model Stand\n  Real y = z;\nend Stand;\n", encoding="utf-8")

    async def script(editor: Editor) -> None:
        assert [d.code for d in await editor.open("model Stand\n  Real y = z;\nend Stand;\n")] == ["R002"]
        assert await editor.type("model Stand\n  Real y = time;\nend Stand;\n") == []
        options = lsp.FormattingOptions(tab_size=2, insert_spaces=True)
        await editor.type("model Stand\nReal y=time;\n\n\nend Stand;")
        edits = await editor.client.text_document_formatting_async(
            lsp.DocumentFormattingParams(lsp.TextDocumentIdentifier(editor.uri), options)
        )
        assert edits[0].new_text == "model Stand\n  Real y=time;\n\nend Stand;\n"

    drive(tmp_path / "Stand.mo", script)


def test_what_an_edit_leaves_alone_is_kept_and_what_it_touches_is_not(tmp_path: Path) -> None:
    """Edits one after another, in the buffer, in another open file and on disk, are found as by a server that sees
    each for the first time."""
    pack = tmp_path / "P"
    pack.mkdir()
    texts = {
        "package": "package P end P;\n",
        "Base": "within P;\npartial model Base\n  Real x(start=1, fixed=true);\nend Base;\n",
        "Part": "within P;\nmodel Part\n  parameter Real k = 2;\n  Real y;\nequation\n  y = k*time;\nend Part;\n",
        "Top": "within P;\nmodel Top\n  extends Base;\n  Part part(k = 3);\n  Real s;\nequation\n"
               "  der(x) = -x;\n  s = part.y;\nend Top;\n",
    }  # fmt: skip
    for name, text in texts.items():
        (pack / f"{name}.mo").write_text(text, encoding="utf-8")
    top, part, base = (pack / f"{name}.mo" for name in ("Top", "Part", "Base"))
    space = Workspace([str(MODEL_FOLDER)])

    def codes(*edits: tuple[Path, str | None]) -> list[str]:
        for path, text in edits:
            space.change(path, text)
        fresh = Workspace([str(MODEL_FOLDER)])
        fresh.texts = dict(space.texts)
        found = space.view(top).findings
        assert [str(f) for f in found] == [str(f) for f in fresh.view(top).findings]
        return [f.code for f in found]

    text = texts["Top"]
    assert codes((top, text)) == []
    assert codes((top, text.replace("model Top", "model Top // a comment"))) == []
    assert codes((top, text.replace("part.y", "part.z"))) == ["R003"]
    assert codes((top, text.replace("part.y;", "part.z; // again"))) == ["R003"]
    assert codes((top, text.replace("Top\n", "Top\n\n", 1).replace("part.y", "part.z"))) == ["R003"]
    assert codes((top, text)) == []
    assert codes((part, texts["Part"].replace("Real y", "Real z"))) == ["R002", "R003"]  # unsaved
    assert codes((part, None)) == []
    assert codes((top, text.replace("Part part", "Prat part"))) == ["R001"]
    assert codes((top, text)) == []
    base.write_text(texts["Base"].replace("Real x", "Real w"), encoding="utf-8")  # by another program
    assert codes((top, text + "\n")) == ["R002"]
    base.write_text(texts["Base"], encoding="utf-8")
    assert codes((top, text)) == []
    base.unlink()
    assert codes((top, text + "\n")) == ["R001"]
    base.write_text(texts["Base"], encoding="utf-8")
    assert codes((pack / "package.mo", 'package P "changed"\nend P;\n'), (top, text)) == []
    assert codes((top, text.replace("model Top", "model Tip").replace("end Top", "end Tip"))) != []
    assert codes((top, text)) == []
