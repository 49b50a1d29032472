"""The language server, as a client sees it that has started it."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from lsprotocol import types as lsp

from language_client import Client, Work, client_in_thread
from ttr.cli.main import main
from ttr.editing.findings import check_file

KENNEL = "# All that barks.\nbasic Ind\npred dog(Ind)\nobject fido : Ind\n"
PARK = 'import "kennel.ttr"\nDog := [x : Ind, c : dog(x)]\ncheck Dog <= [x : Ind]\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "kennel.ttr").write_text(KENNEL)
    (tmp_path / "park.ttr").write_text(PARK)
    return tmp_path


@pytest.fixture(scope="module")
def with_client() -> Iterator[Callable[[Work], None]]:
    """Does what is to be done with a client, which all tests of the module share."""
    with client_in_thread() as run:
        yield run


def place(found: lsp.Diagnostic) -> tuple[int, int, int]:
    assert found.range.start.line == found.range.end.line
    return (
        found.range.start.line,
        found.range.start.character,
        found.range.end.character,
    )


def test_what_is_wrong_is_what_check_says_as_one_types(
    folder: Path, with_client: Callable[[Work], None]
) -> None:
    async def work(client: Client) -> None:
        park = client.open(folder / "park.ttr")
        assert await client.diagnostics(park) == []
        wrong = PARK + "X := [x : Ind@'😀', c : dgo(x)]\n"
        client.type(park, wrong)
        (found,) = await client.diagnostics(park)
        assert found.message == "there is no predicate dgo\nhelp: did you mean dog?"
        assert place(found) == (3, 24, 27)  # in UTF-16
        (folder / "park.ttr").write_text(wrong)
        (told,) = check_file(folder / "park.ttr").findings
        assert (told.line, told.column, told.length) == (4, 24, 3)
        client.type(park, PARK + "check Ind <= ~Ind\n")
        (found,) = await client.diagnostics(park)
        assert found.message.startswith("failed: check Ind <= ~Ind: expected yes")

    with_client(work)


def test_unsaved_imports_count_and_are_told_where_they_are_imported(
    folder: Path, with_client: Callable[[Work], None]
) -> None:
    async def work(client: Client) -> None:
        park = client.open(folder / "park.ttr")
        kennel = client.open(folder / "kennel.ttr")
        assert await client.diagnostics(park) == []
        client.type(kennel, KENNEL.replace("dog", "cat"))
        (found,) = await client.diagnostics(park, bool)
        assert found.message.startswith("there is no predicate dog\nhelp: ")
        client.type(kennel, KENNEL + "Y := [y : Idn]\n")
        (found,) = await client.diagnostics(park, lambda found: "Idn" in str(found))
        assert place(found) == (0, 7, 19)
        assert found.message.startswith("kennel.ttr:5:11: nothing is called Idn here")
        assert found.related_information is not None
        assert found.related_information[0].location.uri == kennel
        client.text_document_did_close(
            lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(kennel))
        )
        assert await client.diagnostics(park, lambda found: not found) == []

    with_client(work)


def test_names_are_explained_found_and_completed(
    folder: Path, with_client: Callable[[Work], None]
) -> None:
    text = PARK + "f := \\x:Ind. [e : dog(x)]\nG := f(fido)\ncheck n"

    async def work(client: Client) -> None:
        park = client.open(folder / "park.ttr", text)
        await client.diagnostics(park)

        async def hover(line: int, character: int) -> str:
            at = lsp.HoverParams(**client.at(park, line, character))
            found = await client.text_document_hover_async(at)
            if found is None:
                return ""
            assert isinstance(found.contents, lsp.MarkupContent)
            return found.contents.value

        assert await hover(1, 22) == "```ttr\npred dog(Ind)\n```"
        assert await hover(1, 13) == "```ttr\nbasic Ind\n```\n\nAll that barks\\."
        assert await hover(4, 8) == "```ttr\nobject fido : Ind\n```\n\nfido : Ind"
        told = "```ttr\nG := f(fido)\n```\n\ncomputes to\n```ttr\n[e : dog(fido)]\n```"
        assert await hover(4, 0) == told
        assert await hover(2, 0) == ""

        async def definition(line: int, character: int) -> list[tuple[str, int, int]]:
            at = lsp.DefinitionParams(**client.at(park, line, character))
            found = await client.text_document_definition_async(at)
            assert isinstance(found, list)
            places = [it for it in found if isinstance(it, lsp.Location)]
            return [
                (Path(it.uri).name, it.range.start.line, it.range.start.character)
                for it in places
            ]

        assert await definition(1, 22) == [("kennel.ttr", 2, 5)]
        assert await definition(2, 7) == [("park.ttr", 1, 0)]
        assert await definition(0, 10) == [("kennel.ttr", 0, 0)]

        async def completed(line: int, character: int) -> set[str]:
            at = lsp.CompletionParams(**client.at(park, line, character))
            found = await client.text_document_completion_async(at)
            assert isinstance(found, list)
            return {it.label for it in found}

        assert {"Dog", "dog", "fido", "not", "unknown", "list"} <= await completed(5, 7)
        client.type(park, text + " [x : Dog]\nb := {x = s.")
        assert {"x", "c", "e"} == await completed(6, 12)
        client.type(park, text + " [x : Dog]\nrule")
        assert {"rule", "strategy", "game"} <= await completed(6, 4)

        at = lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(park))
        symbols = await client.text_document_document_symbol_async(at)
        assert [it.name for it in symbols or []] == ["Dog", "f", "G"]

    with_client(work)


def test_stories_are_checked_too(
    folder: Path, with_client: Callable[[Work], None]
) -> None:
    games = Path(__file__).resolve().parent.parent / "games"

    async def work(client: Client) -> None:
        (folder / "door.ttr").write_text((games / "door.ttr").read_text())
        text = "@ game door.ttr door\n--- one\nU> Greet\nS> GreetBack\nS> Open\n"
        story = client.open(folder / "a.dlg", text)
        (found,) = await client.diagnostics(story, lambda it: "Ask" in str(it))
        assert found.message == "one: expected Open, found Ask"
        assert place(found) == (4, 3, 7)
        (found,) = await client.diagnostics(story)
        at = lsp.HoverParams(**client.at(story, 2, 4))
        hover = await client.text_document_hover_async(at)
        assert "Greet     := [e : greet(guest, host)]" in str(hover)

    with_client(work)


def pigeons(holes: int) -> str:
    """A theory whose checks take long: no hole for one pigeon more than there are."""
    at = [[f"P{p}H{h}" for h in range(holes)] for p in range(holes + 1)]
    parts = [f"({' | '.join(row)})" for row in at]
    parts += [
        f"~({one[h]} /\\ {other[h]})"
        for h in range(holes)
        for i, one in enumerate(at)
        for other in at[:i]
    ]
    names = ", ".join(name for row in at for name in row)
    checks = f"check {' & '.join(parts)} <= B\n" * 8
    return f"basic {names}, B\nSlow := [x : B]\n{checks}"


def children_of(process: int) -> set[str]:
    return set(Path(f"/proc/{process}/task/{process}/children").read_text().split())


def is_running(process: str) -> bool:
    """Is this a process that has not ended, whoever has yet to be told of its end?"""
    try:
        told = Path(f"/proc/{process}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
    return told.rpartition(")")[2].split()[0] not in "ZX"


def test_newest_text_wins_over_a_check_that_takes_long(
    folder: Path, with_client: Callable[[Work], None]
) -> None:
    async def work(client: Client) -> None:
        uri = client.open(folder / "slow.ttr", "basic A\n")
        assert await client.diagnostics(uri) == []
        worker = children_of(client.process)
        client.type(uri, pigeons(9))
        hovered = None
        while hovered is None:  # until its names are known, and its checks at work
            at = lsp.HoverParams(**client.at(uri, 1, 0))
            hovered = await client.text_document_hover_async(at)
        client.type(uri, "basic A\nX := [x : B]\n")
        (found,) = await client.diagnostics(uri)
        assert found.message.startswith("nothing is called B here")
        assert children_of(client.process).isdisjoint(worker)

    with_client(work)


def test_hostile_texts_are_told_in_a_line(
    folder: Path, with_client: Callable[[Work], None]
) -> None:
    (folder / "trap.py").write_text("open('sprung', 'w').close()\n")
    (folder / "broken.ttr").write_bytes(b"basic \xff\xfe\n")

    async def work(client: Client) -> None:
        huge = client.open(folder / "huge.ttr", "# " + "a" * 600_000)
        (found,) = await client.diagnostics(huge)
        assert "and no more than 500 kB are read" in found.message
        texts = {
            'import "broken.ttr"\n': "broken.ttr is no text: it must be UTF-8",
            'import "../../x.ttr"\n': "lies in another folder",
            "X := " + "[x : " * 500: "nest at most 100 deep",
            "basic A\x00\x1b\n": "the control character",
        }
        uri = client.open(folder / "a.ttr", "")
        for text, told in texts.items():
            client.type(uri, text)
            found, *_ = await client.diagnostics(uri)
            assert told in found.message
        story = client.open(folder / "a.dlg", "@ game trap.py:game\nU> Hello\n")
        assert await client.diagnostics(story) == []

    before = sorted(folder.iterdir())
    with_client(work)
    assert sorted(folder.iterdir()) == before


def test_the_server_and_its_worker_end_when_their_client_dies(folder: Path) -> None:
    processes: set[str] = set()

    async def work(client: Client) -> None:
        await client.diagnostics(client.open(folder / "park.ttr"))
        processes.update(children_of(client.process), {str(client.process)})

    with client_in_thread() as run:
        run(work)
    assert len(processes) == 2
    assert [it for it in processes if is_running(it)] == []


def test_without_pygls_there_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delitem(sys.modules, "ttr.editing.server", raising=False)
    monkeypatch.setitem(sys.modules, "pygls", None)
    monkeypatch.delitem(sys.modules, "pygls.lsp.server", raising=False)
    assert main(["lsp"]) == 2
    said = capsys.readouterr().err
    assert said == "ttr: lsp needs pygls: install it by pip install 'kille[editor]'\n"


def test_it_ends_well_when_an_editor_says_goodbye() -> None:
    """It closed the standard output, and then failed to flush that."""

    async def work() -> None:
        async with Client() as client:
            await client.shutdown_async(None)
            client.exit(None)

    # A browser that another test has open keeps a loop running in this thread.
    with ThreadPoolExecutor(1) as other:
        other.submit(asyncio.run, work()).result()
