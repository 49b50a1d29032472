"""The language server `ttr lsp`: errors as one types, hovering, jumping, completing.

It speaks the Language Server Protocol over its standard input and output, and writes
nothing else. Files are checked by a process of its own (`worker`), which is ended where
it is still at work on a text that has changed since, so that the server never waits.
What is not saved yet stands for the files, also where another file imports it.
"""

from __future__ import annotations

import asyncio
import os
import re
import sys
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls import uris
from pygls.lsp.server import LanguageServer
from pygls.workspace import TextDocument

from ttr.dialogues.stories.line_events import VERBS
from ttr.dialogues.stories.story_reader import MARKS
from ttr.editing.outline import Declaration, declarations
from ttr.editing.story_tokens import story_tokens
from ttr.editing.tokens import (
    AFTER_TERMS,
    BEFORE_BRACKETS,
    FOLLOWING,
    NAMES,
    Kind,
    Token,
    theory_tokens,
)
from ttr.escapes import json_text
from ttr.notation.syntax_errors import KEYWORDS
from ttr.safety.inputs import parse_json
from ttr.safety.limits import STORIES, THEORY
from ttr.types.reserved_words import LOGICAL

_PAUSE = 0.2
"""After how many seconds without a change a text is checked."""

_GRACE = 0.5
"""How many more seconds the check of a text that has changed may take."""

_PATIENCE = 120
"""After how many seconds a check is given up."""

_REPLY = 100_000_000
"""The longest reply of the worker, in bytes."""


def language_server(allow: Sequence[Path], steps: int) -> LanguageServer:
    """The server, not started yet.

    Files may import from their own folders and from those in `allow`; each check may
    take so many steps.
    """
    server = LanguageServer(
        "ttr",
        version("kille"),
        text_document_sync_kind=lsp.TextDocumentSyncKind.Full,
    )
    editor = _Editor(server, allow, steps)

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        editor.note_change(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        editor.note_change(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: lsp.DidSaveTextDocumentParams) -> None:
        editor.note_change(params.text_document.uri)

    @server.feature(lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def watched(params: lsp.DidChangeWatchedFilesParams) -> None:
        for change in params.changes:
            editor.note_change(change.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        editor.forget(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        return editor.hover(params.text_document.uri, params.position)

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> list[lsp.Location]:
        return editor.definition(params.text_document.uri, params.position)

    @server.feature(
        lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=["."])
    )
    def completion(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        return editor.completions(params.text_document.uri, params.position)

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        return editor.symbols(params.text_document.uri)

    return server


@dataclass
class _Known:
    """What the last check of a document found: the names in scope, the files read."""

    names: dict[str, dict[str, Any]] = field(default_factory=dict)
    files: frozenset[str] = frozenset()


class _Editor:
    """The open documents, and what is known about them."""

    def __init__(
        self, server: LanguageServer, allow: Sequence[Path], steps: int
    ) -> None:
        self._server = server
        self._allow = [os.path.abspath(one) for one in allow]
        self._steps = steps
        self._known: dict[str, _Known] = {}
        self._checks = _Checks(self)

    # --- documents ---

    def document(self, uri: str) -> TextDocument | None:
        """An open document that is a file of a theory or of stories."""
        is_ours = _path_of(uri).endswith((".ttr", ".dlg"))
        return self._server.workspace.text_documents.get(uri) if is_ours else None

    def _documents(self) -> list[TextDocument]:
        uris_known = list(self._server.workspace.text_documents)
        return [it for it in map(self.document, uris_known) if it is not None]

    def note_change(self, uri: str) -> None:
        """Has a document checked anew, and every other one that has read it."""
        path = _path_of(uri)
        for one in self._documents():
            files = self._known.get(one.uri, _Known()).files
            if one.uri == uri or path in files:
                self._checks.schedule(one.uri)

    def forget(self, uri: str) -> None:
        """Forgets a document that is closed: what is on disk counts again."""
        self._known.pop(uri, None)
        self._publish(uri, None, [])
        self.note_change(uri)

    def request_for(self, uri: str) -> dict[str, Any] | None:
        """What the worker is asked; None for a document that is closed."""
        if self.document(uri) is None:
            return None
        texts = {_path_of(one.uri): one.source for one in self._documents()}
        return {
            "path": _path_of(uri),
            "texts": texts,
            "allow": self._allow,
            "steps": self._steps,
        }

    def version_of(self, uri: str) -> int | None:
        """The version of a document."""
        found = self.document(uri)
        return None if found is None else found.version

    def versions(self) -> dict[str, int | None]:
        """The version of each open document, by its path."""
        return {_path_of(one.uri): one.version for one in self._documents()}

    # --- what the worker says ---

    def take_names(self, uri: str, names: list[dict[str, Any]]) -> None:
        """Takes the names in scope; what is broken for now forgets none of them."""
        known = self._known.setdefault(uri, _Known())
        if names:
            known.names = {one["name"]: one for one in names}

    def take_findings(
        self,
        uri: str,
        checked_version: int | None,
        findings: list[dict[str, Any]],
        files: Iterable[str] = (),
    ) -> None:
        """Shows what is wrong with a document."""
        document = self.document(uri)
        if document is None or document.version != checked_version:
            return  # it is closed, or will be checked again
        self._known.setdefault(uri, _Known()).files = frozenset(files)
        found = [self._diagnostic(document, one) for one in findings]
        self._publish(uri, checked_version, found)

    def _publish(
        self, uri: str, checked_version: int | None, found: list[lsp.Diagnostic]
    ) -> None:
        self._server.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri, found, checked_version)
        )

    def _diagnostic(
        self, document: TextDocument, finding: dict[str, Any]
    ) -> lsp.Diagnostic:
        told = finding["message"]
        if finding["hint"]:
            told += f"\nhelp: {finding['hint']}"
        line, related = finding["line"], None
        place = self._range(
            document, line, finding["column"], finding["column"] + finding["length"]
        )
        file = os.path.abspath(finding["file"])
        if file != _path_of(document.uri):  # it is in a file that this one imports
            there = lsp.Position(line - 1, 0)
            location = lsp.Location(
                str(uris.from_fs_path(file)), lsp.Range(there, there)
            )
            related = [lsp.DiagnosticRelatedInformation(location, finding["message"])]
            told = f"{os.path.basename(file)}:{line}:{finding['column']}: {told}"
            place = self._range_of_import(document, file)
        return lsp.Diagnostic(
            place,
            told,
            lsp.DiagnosticSeverity.Warning
            if finding["severity"] == "warning"
            else lsp.DiagnosticSeverity.Error,
            source="ttr",
            related_information=related,
        )

    def _range_of_import(self, document: TextDocument, file: str) -> lsp.Range:
        """Where a document names a file; its first line if only another one does."""
        for token in _tokens(document):
            if token.kind is Kind.STRING:
                named = token.of(_text_of(document))[1:-1]
                if os.path.abspath(_beside(document, named)) == file:
                    return self._range_of(document, token.start, token.end)
        return self._range(document, 1, 1, 2)

    # --- what the user asks ---

    def hover(self, uri: str, position: lsp.Position) -> lsp.Hover | None:
        """The statements that declare a name, what they mean, and the comments."""
        found = self._name_at(uri, position)
        if found is None:
            return None
        document, token, name = found
        meaning = self._known.get(uri, _Known()).names.get(name)
        if meaning is None:
            return None
        parts = [_fence_notation("\n".join(meaning["statements"]))]
        parts += [_as_markdown(one) for one in (*meaning["about"], meaning["comment"])]
        return lsp.Hover(
            lsp.MarkupContent(
                lsp.MarkupKind.Markdown, "\n\n".join(part for part in parts if part)
            ),
            self._range_of(document, token.start, token.end),
        )

    def definition(self, uri: str, position: lsp.Position) -> list[lsp.Location]:
        """Where a name is declared; or the file that is imported."""
        document = self.document(uri)
        if document is None:
            return []
        token = self._token_at(document, position)
        if token is not None and token.kind is Kind.STRING:
            file = _beside(document, token.of(_text_of(document))[1:-1])
            start = lsp.Position(0, 0)
            there = str(uris.from_fs_path(os.path.abspath(file)))
            is_theory = file.endswith(".ttr") and os.path.isfile(file)
            return [lsp.Location(there, lsp.Range(start, start))] if is_theory else []
        found = self._name_at(uri, position)
        if found is None:
            return []
        name = found[2]
        here = [
            lsp.Location(uri, self._range_of_span(document, vars(one.span)))
            for one in _declarations_in(_text_of(document))
            if one.name == name and not _is_story(uri)
        ]
        places = self._known.get(uri, _Known()).names.get(name, {}).get("places", ())
        return here or [
            lsp.Location(
                str(uris.from_fs_path(os.path.abspath(place["source"]))),
                self._range_of_span(document, place),
            )
            for place in places
        ]

    def completions(self, uri: str, position: lsp.Position) -> list[lsp.CompletionItem]:
        """The words that may stand at a place: names, labels, keywords."""
        document = self.document(uri)
        if document is None:
            return []
        text, at = _text_of(document), self._offset(document, position)
        line = text[text.rfind("\n", 0, at) + 1 : at]
        word = re.search(r"\w*$", line)
        before = line[: word.start()] if word else line
        around = self._token_at(document, position)
        if around is not None and around.kind is Kind.COMMENT:
            return []
        if around is not None and around.kind in _QUOTED and not _is_story(uri):
            return []
        if _is_story(uri) and not before.strip():
            return [_item(mark, lsp.CompletionItemKind.Keyword) for mark in MARKS]
        items = {
            token.of(text): _ITEMS[token.kind]
            for token in _tokens(document)
            if token.kind in (Kind.LABEL, Kind.VARIABLE) and token.end != at
        }
        if before.endswith("."):
            return [_item(name, kind) for name, kind in items.items()]
        known = self._known.get(uri, _Known()).names
        details = {name: one["statements"][0] for name, one in known.items()}
        items |= {name: _ITEMS[Kind(one["kind"])] for name, one in known.items()}
        for one in () if _is_story(uri) else _declarations_in(text):
            items[one.name] = _ITEMS[one.kind]
            details[one.name] = one.statement
        words = _words_after(before, _is_story(uri))
        items = dict.fromkeys(sorted(words), lsp.CompletionItemKind.Keyword) | items
        return [_item(name, kind, details.get(name)) for name, kind in items.items()]

    def symbols(self, uri: str) -> list[lsp.DocumentSymbol]:
        """The names that a theory declares; the titles of stories."""
        document = self.document(uri)
        if document is None:
            return []
        if _is_story(uri):
            return self._titles(document)
        return [
            lsp.DocumentSymbol(
                one.name,
                _SYMBOLS[one.kind],
                self._range_of(document, one.start, one.end),
                self._range_of_span(document, vars(one.span)),
            )
            for one in _declarations_in(_text_of(document))
        ]

    def _titles(self, document: TextDocument) -> list[lsp.DocumentSymbol]:
        found = []
        for title in re.finditer(r"^[ \t]*---(.*\S)", _text_of(document), re.MULTILINE):
            place = self._range_of(document, *title.span())
            name = title[1].strip()
            found.append(lsp.DocumentSymbol(name, lsp.SymbolKind.Event, place, place))
        return found

    # --- places ---

    def _name_at(
        self, uri: str, position: lsp.Position
    ) -> tuple[TextDocument, Token, str] | None:
        """The name that stands at a place."""
        document = self.document(uri)
        token = None if document is None else self._token_at(document, position)
        if document is None or token is None:
            return None
        is_said = _is_story(uri) and token.kind is Kind.STRING  # a move, perhaps
        if token.kind not in NAMES and not is_said:
            return None
        return document, token, token.of(_text_of(document))

    def _token_at(self, document: TextDocument, position: lsp.Position) -> Token | None:
        """The token around a place, or the one that ends there."""
        at = self._offset(document, position)
        near = [it for it in _tokens(document) if it.start <= at <= it.end]
        named = [it for it in near if it.kind in NAMES or it.kind is Kind.STRING]
        return next(iter(named or near), None)

    def _units(self, document: TextDocument, text: str) -> int:
        """How long a text is for the client, which may count in UTF-16."""
        return int(document.position_codec.client_num_units(text))

    def _offset(self, document: TextDocument, position: lsp.Position) -> int:
        text = _text_of(document)
        starts = _line_starts(text)
        if position.line >= len(starts):
            return len(text)
        at, units = starts[position.line], 0
        while at < len(text) and text[at] != "\n" and units < position.character:
            units += self._units(document, text[at])
            at += 1
        return at

    def _position(self, document: TextDocument, at: int) -> lsp.Position:
        text = _text_of(document)
        starts = _line_starts(text)
        line = bisect_right(starts, at) - 1
        return lsp.Position(line, self._units(document, text[starts[line] : at]))

    def _range_of(self, document: TextDocument, start: int, end: int) -> lsp.Range:
        return lsp.Range(self._position(document, start), self._position(document, end))

    def _range(
        self, document: TextDocument, line: int, column: int, end: int
    ) -> lsp.Range:
        """The place of characters in a line; all counted from 1."""
        text = _text_of(document)
        starts = _line_starts(text)
        start = starts[line - 1] if line <= len(starts) else len(text)
        shown = text[start : start + end].partition("\n")[0]
        return self._range_in(document, line, shown, column, end)

    def _range_in(
        self, document: TextDocument, line: int, text: str, column: int, end: int
    ) -> lsp.Range:
        first = self._units(document, text[: column - 1])
        last = first + max(1, self._units(document, text[column - 1 : end - 1]))
        return lsp.Range(lsp.Position(line - 1, first), lsp.Position(line - 1, last))

    def _range_of_span(self, document: TextDocument, span: Any) -> lsp.Range:
        """The place of a span, which has the text of its line."""
        column, end = span["column"], span["column"] + span["length"]
        return self._range_in(document, span["line"], span["text"], column, end)


# --- checking ------------------------------------------------------------------------


class _Checks:
    """Has documents checked, the one that waits longest first, the newest text."""

    def __init__(self, editor: _Editor) -> None:
        self._editor = editor
        self._timers: dict[str, asyncio.TimerHandle] = {}
        self._due: asyncio.Queue[str] = asyncio.Queue()
        self._worker = _Worker()
        self._running: asyncio.Task[None] | None = None
        self._at_work: tuple[str, int | None] | None = None

    def schedule(self, uri: str) -> None:
        """Has a document checked when it has not changed for a moment."""
        loop = asyncio.get_running_loop()
        if self._running is None:
            self._running = loop.create_task(self._run())
        if uri in self._timers:
            self._timers.pop(uri).cancel()
        self._timers[uri] = loop.call_later(_PAUSE, self._due.put_nowait, uri)
        if self._at_work is not None and self._at_work[0] == uri:
            loop.call_later(_GRACE, self._give_up, self._at_work)

    def _give_up(self, work: tuple[str, int | None]) -> None:
        """Ends a check that is still at work on an old text."""
        if self._at_work is work:
            self._worker.kill()

    async def _run(self) -> None:
        try:
            while True:
                uri = await self._due.get()
                self._timers.pop(uri, None)
                await self._check(uri)
        finally:
            self._worker.kill()

    async def _check(self, uri: str) -> None:
        request, newest = self._editor.request_for(uri), self._editor.version_of(uri)
        if request is None:
            return
        versions = self._editor.versions()
        self._at_work = (uri, newest)
        try:
            async with asyncio.timeout(_PATIENCE):
                names = await self._worker.ask(request)
                self._editor.take_names(uri, names.get("names", []))
                found = names if "findings" in names else await self._worker.reply()
            self._editor.take_findings(uri, newest, found["findings"], found["files"])
            now = self._editor.versions()
            if any(now.get(it) != versions.get(it) for it in found["files"]):
                self.schedule(uri)
        except TimeoutError:
            self._worker.kill()
            self._complain(uri, newest, f"takes more than {_PATIENCE} seconds")
        except (OSError, EOFError, ValueError):
            self._worker.kill()
            if self._editor.version_of(uri) == newest and uri not in self._timers:
                self._complain(uri, newest, "was ended by the system")
        finally:
            self._at_work = None

    def _complain(self, uri: str, newest: int | None, why: str) -> None:
        finding = {
            **{"file": _path_of(uri), "line": 1, "column": 1, "length": 1},
            **{"message": f"the check {why}", "severity": "warning", "hint": ""},
        }
        self._editor.take_findings(uri, newest, [finding])


class _Worker:
    """The process that checks; it is started when it is needed."""

    def __init__(self) -> None:
        self._process: asyncio.subprocess.Process | None = None

    async def ask(self, request: dict[str, Any]) -> Any:
        """The first reply to a request; `EOFError` if the process ends before."""
        if self._process is None or self._process.returncode is not None:
            # -P: nothing is imported from the folder in which the editor was started.
            self._process = await asyncio.create_subprocess_exec(
                *(sys.executable, "-P", "-m", "ttr.editing.worker"),
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.DEVNULL,
                limit=_REPLY,
            )
        assert self._process.stdin is not None
        self._process.stdin.write(json_text(request).encode() + b"\n")
        await self._process.stdin.drain()
        return await self.reply()

    async def reply(self) -> Any:
        """The next reply."""
        process = self._process
        if process is None or process.stdout is None:
            raise EOFError
        line = await process.stdout.readline()
        if not line:
            raise EOFError
        return parse_json(line)

    def kill(self) -> None:
        """Ends the process, whatever it is doing."""
        if self._process is not None and self._process.returncode is None:
            self._process.kill()
        self._process = None


# --- texts ---------------------------------------------------------------------------


def _path_of(uri: str) -> str:
    """The path of a file on this machine; empty for whatever else is open."""
    found = uris.to_fs_path(uri)
    return os.path.abspath(found) if found and "\0" not in found else ""


def _is_story(uri: str) -> bool:
    return _path_of(uri).endswith(".dlg")


def _beside(document: TextDocument, named: str) -> str:
    return os.path.join(os.path.dirname(_path_of(document.uri)), named)


def _text_of(document: TextDocument) -> str:
    return _plain_lines(document.source)


@lru_cache(maxsize=8)
def _plain_lines(text: str) -> str:
    return text.replace("\r\n", "\n").replace("\r", "\n")


@lru_cache(maxsize=8)
def _line_starts(text: str) -> tuple[int, ...]:
    return (0, *(found.end() for found in re.finditer("\n", text)))


@lru_cache(maxsize=8)
def _declarations_in(text: str) -> tuple[Declaration, ...]:
    """The declarations; none of a text that is too large to be checked."""
    return () if len(text) > THEORY.maximum else declarations(text)


def _tokens(document: TextDocument) -> tuple[Token, ...]:
    return _tokens_of(_text_of(document), _is_story(document.uri))


@lru_cache(maxsize=8)
def _tokens_of(text: str, is_story: bool) -> tuple[Token, ...]:
    """The tokens; none of a text that is too large to be checked."""
    if len(text) > (STORIES if is_story else THEORY).maximum:
        return ()
    return story_tokens(text) if is_story else theory_tokens(text)


def _fence_notation(text: str) -> str:
    """A block of notation in Markdown, whatever backticks are in it."""
    ticks = max((len(it) for it in re.findall("`+", text)), default=0)
    fence = "`" * max(3, ticks + 1)
    return f"{fence}ttr\n{text}\n{fence}"


def _as_markdown(text: str) -> str:
    """Words from a file, without anything that Markdown would act on."""
    if text.startswith("computes to `"):
        return "computes to\n" + _fence_notation(
            text.removeprefix("computes to `")[:-1]
        )
    return re.sub(r"([\\`*_{}\[\]()#+.!<>|~-])", r"\\\1", text)


_QUOTED = (Kind.STRING, Kind.ERROR)
"""The kinds of a quoted text, closed or open."""

_ITEMS = {
    Kind.TYPE: lsp.CompletionItemKind.Class,
    Kind.PREDICATE: lsp.CompletionItemKind.Function,
    Kind.OBJECT: lsp.CompletionItemKind.Constant,
    Kind.RULE: lsp.CompletionItemKind.Method,
    Kind.LABEL: lsp.CompletionItemKind.Field,
    Kind.VARIABLE: lsp.CompletionItemKind.Variable,
}

_SYMBOLS = {
    Kind.TYPE: lsp.SymbolKind.Class,
    Kind.PREDICATE: lsp.SymbolKind.Function,
    Kind.OBJECT: lsp.SymbolKind.Constant,
    Kind.RULE: lsp.SymbolKind.Method,
}


def _item(
    name: str, kind: lsp.CompletionItemKind, detail: str | None = None
) -> lsp.CompletionItem:
    return lsp.CompletionItem(name, kind=kind, detail=detail)


def _words_after(before: str, is_story: bool) -> frozenset[str]:
    """The words of the notation that may follow the text of a line."""
    words = frozenset((*LOGICAL, *BEFORE_BRACKETS))
    if is_story:
        return frozenset(VERBS) if before.strip() == "@" else words
    if not before.strip():
        return words | {*KEYWORDS, "where", "of", "if", "only"}
    last = before.split()[-1]
    if last in FOLLOWING:
        return words | FOLLOWING[last]
    return words.union(*AFTER_TERMS.values(), ("acts", "hears"))
