"""A client of the language server, for tests: what it is told, and what it asks."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from typing import Any

from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

PATIENCE = 60  # seconds


class Client(LanguageClient):
    """A client with the server as its child; `told` has the latest diagnostics."""

    def __init__(self) -> None:
        super().__init__("tests", "1")
        self.told: dict[str, lsp.PublishDiagnosticsParams] = {}
        self._news = asyncio.Event()
        self._versions: dict[str, int] = {}

        @self.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def take(params: lsp.PublishDiagnosticsParams) -> None:
            self.told[params.uri] = params
            self._news.set()

    async def __aenter__(self) -> Client:
        await self.start_io(sys.executable, "-m", "ttr.cli.main", "lsp")
        await self.initialize_async(
            lsp.InitializeParams(capabilities=lsp.ClientCapabilities())
        )
        self.initialized(lsp.InitializedParams())
        return self

    async def __aexit__(self, *_: object) -> None:
        """Hangs up without a word, as a client does that dies; the server must end."""
        server = self._server
        assert server is not None
        assert server.stdin is not None
        server.stdin.close()
        assert await asyncio.wait_for(server.wait(), PATIENCE) == 0
        await asyncio.wait_for(self.stop(), PATIENCE)

    @property
    def process(self) -> int:
        """The number of the server's process."""
        assert self._server is not None
        return self._server.pid

    # --- what the user does ---

    def open(self, path: Path, text: str | None = None) -> str:
        """Opens a file, with this text or its own, and gives its address."""
        uri = path.as_uri()
        shown = path.read_text("utf-8") if text is None else text
        self._versions[uri] = 1
        item = lsp.TextDocumentItem(uri, path.suffix[1:], 1, shown)
        self.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        return uri

    def type(self, uri: str, text: str) -> None:
        """Replaces the text of a document, without saving it."""
        self._versions[uri] += 1
        document = lsp.VersionedTextDocumentIdentifier(self._versions[uri], uri)
        self.text_document_did_change(
            lsp.DidChangeTextDocumentParams(
                document, [lsp.TextDocumentContentChangeWholeDocument(text)]
            )
        )

    def at(self, uri: str, line: int, character: int) -> dict[str, Any]:
        return {
            "text_document": lsp.TextDocumentIdentifier(uri),
            "position": lsp.Position(line, character),
        }

    # --- what is waited for ---

    async def diagnostics(
        self, uri: str, fits: Callable[[list[lsp.Diagnostic]], bool] | None = None
    ) -> list[lsp.Diagnostic]:
        """The diagnostics of the newest text, as soon as they fit."""

        async def wait() -> list[lsp.Diagnostic]:
            while True:
                told = self.told.get(uri)
                if told is not None and told.version == self._versions[uri]:
                    found = list(told.diagnostics)
                    if fits is None or fits(found):
                        return found
                self._news.clear()
                await self._news.wait()

        return await asyncio.wait_for(wait(), PATIENCE)


Work = Callable[[Client], Coroutine[Any, Any, None]]


@contextmanager
def client_in_thread() -> Iterator[Callable[[Work], None]]:
    """Runs what needs a client, in a thread: a browser may have the main one's loop."""
    loop = asyncio.new_event_loop()
    thread = Thread(target=loop.run_forever)
    thread.start()

    def run(work: Coroutine[Any, Any, Any]) -> Any:
        return asyncio.run_coroutine_threadsafe(work, loop).result(4 * PATIENCE)

    client = Client()
    try:
        run(client.__aenter__())
        yield lambda work: run(work(client))
    finally:
        run(client.__aexit__())
        run(loop.shutdown_asyncgens())
        loop.call_soon_threadsafe(loop.stop)
        thread.join(PATIENCE)
        loop.close()
