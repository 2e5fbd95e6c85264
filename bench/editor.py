"""A real client: the server as a process, the protocol over its standard input and output."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
import os
from pathlib import Path
import sys
from typing import Any

from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

SERVER = "import lacuna; lacuna.serve_editor()"
PATIENCE = 60  # s; on a loaded machine


class Editor:
    """One open file and what the server has said of it."""

    def __init__(self, client: LanguageClient, path: Path):
        self.client, self.path, self.uri, self._version = client, path, path.as_uri(), 0
        self._found: asyncio.Queue[list[lsp.Diagnostic]] = asyncio.Queue()
        self.text = ""

        @client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def published(params: lsp.PublishDiagnosticsParams) -> None:
            if params.uri == self.uri:
                self._found.put_nowait(list(params.diagnostics))

    def busy(self) -> float:
        """Processor time of the server's main thread so far, s; Linux counts it."""
        server = self.client._server
        assert server is not None
        return int(Path(f"/proc/{server.pid}/schedstat").read_text(encoding="ascii").split()[0]) * 1e-9

    async def open(self, text: str) -> list[lsp.Diagnostic]:
        self.text = text
        item = lsp.TextDocumentItem(self.uri, "modelica", 0, text)
        self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        return await asyncio.wait_for(self._found.get(), PATIENCE)

    async def type(self, text: str) -> list[lsp.Diagnostic]:
        """The whole text after a keystroke; what the server publishes then."""
        self.text, self._version = text, self._version + 1
        document = lsp.VersionedTextDocumentIdentifier(self._version, self.uri)
        whole = lsp.TextDocumentContentChangeWholeDocument(text)
        self.client.text_document_did_change(lsp.DidChangeTextDocumentParams(document, [whole]))
        return await asyncio.wait_for(self._found.get(), PATIENCE)

    def place(self, marked: str) -> dict[str, Any]:
        """Text document and position of the `|` in `marked`, which is part of the text without it."""
        offset = self.text.index(marked.replace("|", "")) + marked.index("|")
        line = self.text.count("\n", 0, offset)
        character = offset - (self.text.rfind("\n", 0, offset) + 1)
        return {"text_document": lsp.TextDocumentIdentifier(self.uri), "position": lsp.Position(line, character)}


def drive(path: Path, script: Callable[[Editor], Coroutine[Any, Any, None]]) -> None:
    """Run `script` with an editor that has started a server."""

    async def run() -> None:
        client = LanguageClient("test", "1")
        await client.start_io(sys.executable, "-c", SERVER, env=os.environ.copy())
        await client.initialize_async(lsp.InitializeParams(lsp.ClientCapabilities()))
        client.initialized(lsp.InitializedParams())
        try:
            await script(Editor(client, path))
        finally:
            await client.shutdown_async(None)
            client.exit(None)
            await client.stop()

    asyncio.run(run())
