"""Theories and tables that were read before: the same again, whatever the cache has."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

import pytest

from kille.dialogue.language import LANGUAGES
from kille.dialogue.language_files import FILES, STRATEGIES, WORDS, read_table, source
from kille.dialogue.theory_cache import _reader, recall_theory
from kille.dialogue.theory_files import SOURCE, packaged_theory
from kille.dialogue.user_cache import cache_folder, digest
from ttr import Theory, record
from ttr.safety.inputs import parse_toml
from ttr.types.printing import Spelling

SMALL = """
basic Ind
object a : Ind
pred dog(Ind)
Pet := [x : Ind, c : dog(x)]
Cat := [x : Ind, c : ~dog(x)]
"""


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of theories, empty as yet."""
    monkeypatch.setattr(
        "kille.dialogue.user_cache.user_cache_dir", lambda *_, **__: str(tmp_path)
    )
    return cache_folder("theories")


def refuse(*_: object, **__: object) -> NoReturn:
    raise AssertionError("it is read anew")


def recall_without_reading(monkeypatch: pytest.MonkeyPatch, text: str) -> Theory:
    """What is recalled where nothing can be read anew."""
    with monkeypatch.context() as patched:
        patched.setattr("ttr.theories.theory.theory_of_text", refuse)
        return recall_theory(text, SOURCE)


def fields_of(theory: Theory) -> dict[str, Any]:
    """What a theory has, without what was derived of it."""
    found = {name: vars(theory)[name] for name in theory.__dataclass_fields__}
    return {
        **found,
        "spelling": [it.written for it in theory.spelling if isinstance(it, Spelling)],
    }


def packaged_text() -> str:
    folder = Path(__file__).parents[3] / "grammars"
    return (folder / SOURCE).read_text("utf-8")


@pytest.mark.parametrize("text", [SMALL, packaged_text()])
def test_a_theory_is_recalled_as_it_was_read(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = Theory.parse(text, SOURCE)
    assert fields_of(recall_theory(text, SOURCE)) == fields_of(read)
    recalled = recall_without_reading(monkeypatch, text)
    assert fields_of(recalled) == fields_of(read)
    assert all(recalled[it] is read[it] for it in read.definitions)
    assert str(recalled) == str(read)


def test_the_packaged_theory_is_what_its_text_says() -> None:
    assert fields_of(packaged_theory()) == fields_of(
        Theory.parse(packaged_text(), SOURCE)
    )


def test_a_recalled_theory_is_of_the_same_text_and_the_same_reader(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    recall_theory(SMALL, SOURCE)
    other = SMALL.replace("Cat", "Cow")
    assert "Cow" in recall_theory(other, SOURCE)
    monkeypatch.setattr("kille.dialogue.theory_cache._reader", lambda: "another")
    with pytest.raises(AssertionError, match="read anew"):
        recall_without_reading(monkeypatch, SMALL)


def test_a_reader_is_another_once_a_file_of_it_has_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "inner").mkdir()
    for name in ("__init__.py", "inner/reader.py"):
        (tmp_path / name).write_text("1\n")
    monkeypatch.setattr("ttr.__file__", str(tmp_path / "__init__.py"))
    before = _reader()
    assert _reader() == before
    (tmp_path / "inner/reader.py").write_text("22\n")
    assert _reader() != before


def shorten(body: bytes) -> bytes:
    return body[:-9]


def change_a_name(body: bytes) -> bytes:
    return body.replace(b"Pet", b"Pat")


@pytest.mark.parametrize("damage", [shorten, change_a_name, lambda _: b""])
def test_a_damaged_file_is_made_anew(
    damage: Callable[[bytes], bytes], cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = fields_of(recall_theory(SMALL, SOURCE))
    (kept,) = cache.iterdir()
    kept.write_bytes(damage(kept.read_bytes()))
    assert fields_of(recall_theory(SMALL, SOURCE)) == read
    assert fields_of(recall_without_reading(monkeypatch, SMALL)) == read


class Command:
    """What would run a command when it is read."""

    def __reduce__(self) -> tuple[Any, ...]:
        return Path.touch, (Path("touched"),)


def text(it: str) -> bytes:
    return b"\x8c" + bytes([len(it)]) + it.encode()


def name(module: str, it: str) -> bytes:
    return text(module) + text(it) + b"\x93"


def call(function: bytes, argument: bytes) -> bytes:
    return function + argument + b"\x85R"


def attribute(it: str, of: bytes) -> bytes:
    """An attribute, by what a module of types has imported for itself."""
    return call(call(name("ttr.types.interning", "inspect.attrgetter"), text(it)), of)


def command_by_detours() -> bytes:
    """A pickle that makes a folder, and names nothing outside of `ttr.types`."""
    inside = attribute("__init__.__globals__", name("ttr.types.objects", "Record"))
    builtins = call(attribute("__getitem__", inside), text("__builtins__"))
    imports = call(attribute("__getitem__", builtins), text("__import__"))
    makes = attribute("mkdir", call(imports, text("os")))
    return b"\x80\x04" + call(makes, text("touched")) + b"."


@pytest.mark.parametrize(
    "body",
    [
        *map(pickle.dumps, (Command(), record(x=1), {"a": refuse})),
        command_by_detours(),
    ],
)
def test_what_is_no_theory_is_not_read(
    body: bytes, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(cache.parent)
    read = fields_of(recall_theory(SMALL, SOURCE))
    (kept,) = cache.iterdir()
    whole = digest(body.decode("latin-1"))
    monkeypatch.setattr(
        "kille.dialogue.user_cache._digest_of_bytes", lambda _: whole.encode()
    )
    kept.write_bytes(whole.encode() + b"\n" + body)
    assert fields_of(recall_theory(SMALL, SOURCE)) == read
    assert not Path("touched").exists()


def test_where_nothing_can_be_written_nothing_is_kept(cache: Path) -> None:
    cache.write_text("a file where the folder would be", "utf-8")
    assert "Pet" in recall_theory(SMALL, SOURCE)
    assert cache.is_file()


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("file", [FILES[1], WORDS, STRATEGIES])
def test_a_table_is_recalled_as_it_was_read(
    language: str, file: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = parse_toml(source(file, language))
    assert read_table(file, language) == read
    monkeypatch.setattr("kille.dialogue.language_files.parse_toml", refuse)
    assert read_table(file, language) == read


def test_a_table_with_what_json_lacks_is_read_and_not_kept(tmp_path: Path) -> None:
    (tmp_path / "words.en.toml").write_text("day = 2024-05-01\n")
    assert str(read_table(WORDS, f"{tmp_path}/en")["day"]) == "2024-05-01"
    assert not cache_folder("tables").exists()
