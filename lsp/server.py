"""The language server: the protocol over what `features` knows. Needs the extra `editor` (pygls)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
import gc
from pathlib import Path
from urllib.parse import unquote, urlparse

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer

import lacuna
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.syntax import ast
from lacuna.lsp import features
from lacuna.lsp.features import Workspace
from lacuna.lsp.format import format_text
from lacuna.lsp.positions import Positions
from lacuna.lsp.protocol import AnsweringProtocol
from lacuna.lsp.rename import Refused
from lacuna.lsp.rename import rename as rename_at

_SEVERITY = {"error": lsp.DiagnosticSeverity.Error, "warning": lsp.DiagnosticSeverity.Warning}


def path_of(uri: str) -> Path:
    return Path(unquote(urlparse(uri).path)).resolve()


def make_server(search_path: list[str]) -> LanguageServer:
    """A server over classes looked up in `search_path`."""
    whole = lsp.TextDocumentSyncKind.Full
    server = LanguageServer("lacuna", lacuna.__version__, text_document_sync_kind=whole, protocol_cls=AnsweringProtocol)
    workspace = Workspace(search_path)
    for features_of in (_documents, _questions, _edits):
        features_of(server, workspace, Positions(workspace.text))
    return server


@contextmanager
def _answering() -> Iterator[None]:
    """Garbage is collected behind an answer, not within it."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _documents(server: LanguageServer, workspace: Workspace, positions: Positions) -> None:
    def publish(uri: str) -> None:
        path = path_of(uri)
        with _answering():
            found = features.in_file(workspace.view(path).findings, path)
            diagnostics = [_diagnostic(finding, span, positions) for finding, span in found]
            server.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, diagnostics))

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        workspace.change(path_of(params.text_document.uri), params.text_document.text)
        publish(params.text_document.uri)
        gc.collect()
        gc.freeze()  # the parsed library stays: it need not be looked at again

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        text = server.workspace.get_text_document(params.text_document.uri).source
        workspace.change(path_of(params.text_document.uri), text)
        publish(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        workspace.change(path_of(params.text_document.uri), None)


def _diagnostic(finding: Diagnostic, span: Span, positions: Positions) -> lsp.Diagnostic:
    text = finding.message + (f"\nhint: {finding.hint}" if finding.hint else "")
    notes = [(p, Path(p.file).resolve().as_uri(), remark) for p, remark in finding.notes if p.file]
    related = [lsp.DiagnosticRelatedInformation(lsp.Location(at, positions.range(p)), said) for p, at, said in notes]
    return lsp.Diagnostic(
        positions.range(span), text, severity=_SEVERITY[finding.severity], code=finding.code, source="lacuna",
        related_information=related, data={"fixes": features.fixes(finding)},
    )  # fmt: skip


def _questions(server: LanguageServer, workspace: Workspace, positions: Positions) -> None:
    def asked(params: lsp.TextDocumentPositionParams) -> tuple[Path, int, int]:
        path = path_of(params.text_document.uri)
        return path, *positions.place(path, params.position)

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        path, line, character = asked(params)
        text = features.hover(workspace.view(path), line, character)
        return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text)) if text else None

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        path, line, character = asked(params)
        found = features.declaration(workspace.view(path), line, character)
        if found is None or not found.span.file:
            return None
        return lsp.Location(Path(found.span.file).resolve().as_uri(), positions.range(found.span))

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        found = features.occurrences(workspace, *asked(params))
        return [lsp.Location(path.as_uri(), positions.range(replace(span, file=str(path)))) for path, span in found]

    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[".", '"']))
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        found = features.completions(workspace, *asked(params))
        return [lsp.CompletionItem(name, detail=detail) for name, detail in found.items()]

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        document = workspace.view(path_of(params.text_document.uri)).document
        return [_symbol(entry, positions) for entry in features.outline(document).values()] if document else []


def _symbol(entry: dict, positions: Positions) -> lsp.DocumentSymbol:
    def one(element: ast.Class | ast.Component, kind: lsp.SymbolKind, detail: str) -> lsp.DocumentSymbol:
        place = positions.range(element.span)
        return lsp.DocumentSymbol(element.name, kind, place, place, detail=detail)

    cls = entry["class"]
    symbol = one(cls, lsp.SymbolKind.Package if cls.kind == "package" else lsp.SymbolKind.Class, cls.kind)
    inner = [_symbol(e, positions) for e in entry["classes"].values()]
    symbol.children = [*inner, *(one(c, lsp.SymbolKind.Variable, str(c.type)) for c in entry["components"])]
    return symbol


def _edits(server: LanguageServer, workspace: Workspace, positions: Positions) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_RENAME)
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit:
        path = path_of(params.text_document.uri)
        changes: dict[str, list[lsp.TextEdit]] = {}
        try:
            places = rename_at(workspace, path, *positions.place(path, params.position), params.new_name)
        except Refused as reason:
            raise JsonRpcInvalidParams(str(reason)) from None
        for file, span in places:
            edit = lsp.TextEdit(positions.range(replace(span, file=str(file))), params.new_name)
            changes.setdefault(file.as_uri(), []).append(edit)
        return lsp.WorkspaceEdit(changes=changes)

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def formatting(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit] | None:
        path = path_of(params.text_document.uri)
        text = workspace.text(path)
        try:
            formatted = format_text(text, str(path))
        except Diagnostic:
            return None
        end = lsp.Position(text.count("\n") + 1, 0)
        return [] if formatted == text else [lsp.TextEdit(lsp.Range(lsp.Position(0, 0), end), formatted)]

    @server.feature(lsp.TEXT_DOCUMENT_CODE_ACTION)
    def actions(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        uri = params.text_document.uri
        return [
            _replace(uri, diagnostic, name, positions)
            for diagnostic in params.context.diagnostics
            if positions.marked(path_of(uri), diagnostic.range)  # else of an older text
            for name in (diagnostic.data or {}).get("fixes", [])
        ]


def _replace(uri: str, diagnostic: lsp.Diagnostic, name: str, positions: Positions) -> lsp.CodeAction:
    """The name that was not found, replaced by a known one: the last part of what is marked."""
    at = diagnostic.range
    marked = positions.marked(path_of(uri), at)
    start = at.start.character + (marked.rfind(".") + 1 if "." in marked and "." not in name else 0)
    place = lsp.Range(lsp.Position(at.start.line, start), at.end)
    return lsp.CodeAction(
        f"replace by {name}", kind=lsp.CodeActionKind.QuickFix, diagnostics=[diagnostic],
        edit=lsp.WorkspaceEdit(changes={uri: [lsp.TextEdit(place, name)]}),
    )  # fmt: skip
