"""The language server: the protocol over what `features` knows. Needs the extra `editor` (pygls)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import gc
from pathlib import Path
from urllib.parse import unquote, urlparse

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer

import lacuna
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.syntax.lexer import is_name
from lacuna.lsp import features
from lacuna.lsp.features import Workspace
from lacuna.lsp.format import format_text
from lacuna.lsp.protocol import AnsweringProtocol

_SEVERITY = {"error": lsp.DiagnosticSeverity.Error, "warning": lsp.DiagnosticSeverity.Warning}


def path_of(uri: str) -> Path:
    return Path(unquote(urlparse(uri).path)).resolve()


def _range(span: Span) -> lsp.Range:
    line, column = span.line - 1, span.column - 1
    return lsp.Range(lsp.Position(line, column), lsp.Position(line, column + max(1, span.length)))


def make_server(search_path: list[str]) -> LanguageServer:
    """A server over classes looked up in `search_path`."""
    whole = lsp.TextDocumentSyncKind.Full
    server = LanguageServer("lacuna", lacuna.__version__, text_document_sync_kind=whole, protocol_cls=AnsweringProtocol)
    workspace = Workspace(search_path)
    _documents(server, workspace)
    _questions(server, workspace)
    _edits(server, workspace)
    return server


@contextmanager
def _answering() -> Iterator[None]:
    """Garbage is collected behind an answer, not within it."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _documents(server: LanguageServer, workspace: Workspace) -> None:
    def publish(uri: str) -> None:
        path = path_of(uri)
        with _answering():
            found = features.in_file(workspace.view(path).findings, path)
            diagnostics = [_diagnostic(finding, span) for finding, span in found]
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


def _diagnostic(finding: Diagnostic, span: Span) -> lsp.Diagnostic:
    text = finding.message + (f"\nhint: {finding.hint}" if finding.hint else "")
    related = [
        lsp.DiagnosticRelatedInformation(lsp.Location(Path(place.file).resolve().as_uri(), _range(place)), remark)
        for place, remark in finding.notes if place.file
    ]  # fmt: skip
    return lsp.Diagnostic(
        _range(span), text, severity=_SEVERITY[finding.severity], code=finding.code, source="lacuna",
        related_information=related, data={"fixes": features.fixes(finding)},
    )  # fmt: skip


def _questions(server: LanguageServer, workspace: Workspace) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        view = workspace.view(path_of(params.text_document.uri))
        text = features.hover(view, params.position.line, params.position.character)
        return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text)) if text else None

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        view = workspace.view(path_of(params.text_document.uri))
        found = features.declaration(view, params.position.line, params.position.character)
        if found is None or not found.span.file:
            return None
        return lsp.Location(Path(found.span.file).resolve().as_uri(), _range(found.span))

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        at = params.position
        found = features.occurrences(workspace, path_of(params.text_document.uri), at.line, at.character)
        return [lsp.Location(path.as_uri(), _range(span)) for path, span in found]

    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[".", '"']))
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        at = params.position
        found = features.completions(workspace, path_of(params.text_document.uri), at.line, at.character)
        return [lsp.CompletionItem(name, detail=detail) for name, detail in found.items()]

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        document = workspace.view(path_of(params.text_document.uri)).document
        return [_symbol(entry) for entry in features.outline(document).values()] if document else []


def _symbol(entry: dict) -> lsp.DocumentSymbol:
    cls = entry["class"]
    inner = [_symbol(e) for e in entry["classes"].values()]
    inner += [
        lsp.DocumentSymbol(c.name, lsp.SymbolKind.Variable, _range(c.span), _range(c.span), detail=str(c.type))
        for c in entry["components"]
    ]
    kind = lsp.SymbolKind.Package if cls.kind == "package" else lsp.SymbolKind.Class
    return lsp.DocumentSymbol(cls.name, kind, _range(cls.span), _range(cls.span), detail=cls.kind, children=inner)


def _edits(server: LanguageServer, workspace: Workspace) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_RENAME)
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit:
        if not is_name(params.new_name):
            wanted = "letters, digits and _, or in 'quotes', and no keyword"
            raise JsonRpcInvalidParams(f"{params.new_name!r} is not a name: {wanted}")
        at = params.position
        changes: dict[str, list[lsp.TextEdit]] = {}
        for path, span in features.occurrences(workspace, path_of(params.text_document.uri), at.line, at.character):
            changes.setdefault(path.as_uri(), []).append(lsp.TextEdit(_range(span), params.new_name))
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
        lines = workspace.text(path_of(uri)).split("\n")
        return [
            _replace(uri, lines[diagnostic.range.start.line], diagnostic, name)
            for diagnostic in params.context.diagnostics
            if diagnostic.range.start.line < len(lines)  # else of an older text
            for name in (diagnostic.data or {}).get("fixes", [])
        ]


def _replace(uri: str, line: str, diagnostic: lsp.Diagnostic, name: str) -> lsp.CodeAction:
    """The name that was not found, replaced by a known one: the last part of what is marked."""
    at = diagnostic.range
    marked = line[at.start.character : at.end.character]
    start = at.start.character + (marked.rfind(".") + 1 if "." in marked and "." not in name else 0)
    place = lsp.Range(lsp.Position(at.start.line, start), at.end)
    return lsp.CodeAction(
        f"replace by {name}", kind=lsp.CodeActionKind.QuickFix, diagnostics=[diagnostic],
        edit=lsp.WorkspaceEdit(changes={uri: [lsp.TextEdit(place, name)]}),
    )  # fmt: skip
