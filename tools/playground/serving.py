"""Serves a folder on this machine alone, with the types of content that pages need."""

from __future__ import annotations

from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any


class _Handler(SimpleHTTPRequestHandler):
    extensions_map = {  # noqa: RUF012 - as the class above has it
        **SimpleHTTPRequestHandler.extensions_map,
        ".js": "text/javascript",
        ".mjs": "text/javascript",
        ".wasm": "application/wasm",
        ".json": "application/json",
    }

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing of each request."""


def server_of(folder: Path, port: int = 0) -> ThreadingHTTPServer:
    """A server of a folder on loopback, not yet running; port 0: any that is free."""
    return ThreadingHTTPServer(
        ("127.0.0.1", port), partial(_Handler, directory=str(folder))
    )
