"""Inputs are files or pipes, within limits; what is not is refused in one line."""

from __future__ import annotations

import io
import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr.cli.main import main
from ttr.safety.inputs import (
    DEPTH,
    ask_line,
    open_file,
    parse_json,
    parse_toml,
    read_bytes,
    read_line,
    read_lines,
    read_text,
)
from ttr.safety.limits import FACTOR, LINE, THEORY, InputLimitError, Limit

FEW = Limit(10, "bytes")


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is waited for longer than some hundredths of a second."""
    monkeypatch.setenv(FACTOR, "0.005")


@given(st.binary(max_size=20))
def test_a_file_is_read_if_it_is_within_the_limit(
    tmp_path_factory: pytest.TempPathFactory, data: bytes
) -> None:
    file = tmp_path_factory.getbasetemp() / "any"
    file.write_bytes(data)
    if len(data) <= FEW.most:
        assert read_bytes(file, FEW) == data
    else:
        with pytest.raises(InputLimitError, match=f"it has {len(data)} bytes"):
            read_bytes(file, FEW)


def test_a_text_is_read_as_python_reads_it(tmp_path: Path) -> None:
    file = tmp_path / "a.txt"
    file.write_bytes("\ufeffa\r\nb\rc\né".encode())
    assert read_text(file, THEORY) == file.read_text("utf-8-sig") == "a\nb\nc\né"


def test_a_huge_file_is_refused_before_it_is_read(tmp_path: Path) -> None:
    huge = tmp_path / "huge"
    with huge.open("wb") as file:
        file.truncate(10**12)
    with pytest.raises(InputLimitError, match="it has 1 TB, and no more than 10 bytes"):
        read_bytes(huge, FEW)


def test_a_file_that_says_it_is_empty_is_not_believed() -> None:
    status = Path("/proc/self/status")
    if not status.exists():
        pytest.skip("there is no /proc here")
    assert status.stat().st_size == 0
    with pytest.raises(InputLimitError, match="it has more than 10 bytes"):
        read_bytes(status, FEW)


def test_the_environment_allows_more(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "a"
    file.write_bytes(bytes(25))
    with pytest.raises(InputLimitError, match=f"{FACTOR}=3 reads it all the same"):
        read_bytes(file, FEW)
    monkeypatch.setenv(FACTOR, "3")
    assert read_bytes(file, FEW) == bytes(25)


@pytest.mark.parametrize("wrong", ["", "x", "nan", "-1", "0", "inf", "1e99"])
def test_an_odd_factor_changes_nothing(
    monkeypatch: pytest.MonkeyPatch, wrong: str
) -> None:
    monkeypatch.setenv(FACTOR, wrong)
    assert FEW.maximum == FEW.most


def a_folder(folder: Path) -> Path:
    return folder


def a_loop(folder: Path) -> Path:
    (folder / "loop").symlink_to("loop")
    return folder / "loop"


def a_device(folder: Path) -> Path:
    return Path("/dev/zero")


def a_silent_pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe")
    return folder / "pipe"


def nothing(folder: Path) -> Path:
    return folder / "nothing"


NO_FILES: dict[Callable[[Path], Path], str] = {
    a_folder: "is a directory",
    a_loop: "too many levels of symbolic links",
    a_device: "it is a device, and must be a file",
    a_silent_pipe: "it is a pipe",
    nothing: "no such file",
}


@pytest.mark.parametrize(("made", "why"), NO_FILES.items())
@pytest.mark.parametrize("read", [lambda it: read_bytes(it, THEORY), open_file])
@pytest.mark.usefixtures("impatient")
def test_what_is_no_file_is_refused_with_a_reason(
    tmp_path: Path,
    made: Callable[[Path], Path],
    why: str,
    read: Callable[[Path], object],
) -> None:
    with pytest.raises(OSError, match=f"(?i){why}"):
        read(made(tmp_path))


@pytest.mark.parametrize("path", ["a\0b", "\ud800", "x" * 5000])
def test_what_is_no_path_is_refused(path: str) -> None:
    with pytest.raises(OSError, match=r"no path of a file|name too long"):
        read_bytes(path, THEORY)


def test_a_pipe_is_read_to_its_end(tmp_path: Path) -> None:
    pipe = a_silent_pipe(tmp_path)

    def write() -> None:
        with pipe.open("wb") as file:
            for _ in range(3):
                file.write(b"abc")
                file.flush()

    writer = threading.Thread(target=write)
    writer.start()
    assert read_bytes(pipe, FEW) == b"abcabcabc"
    writer.join()


def test_a_pipe_without_end_is_refused(tmp_path: Path) -> None:
    pipe = a_silent_pipe(tmp_path)
    caught: list[BaseException] = []

    def write() -> None:
        try:
            with pipe.open("wb", buffering=0) as file:
                while True:
                    file.write(bytes(1000))
        except BrokenPipeError as error:
            caught.append(error)

    writer = threading.Thread(target=write)
    writer.start()
    with pytest.raises(InputLimitError, match="it has more than 10 bytes"):
        read_bytes(pipe, FEW)
    writer.join()
    assert caught


# --- lines ---------------------------------------------------------------------------


def test_lines_are_of_some_length_at_most() -> None:
    few = Limit(4, "characters")
    assert read_line(io.StringIO("abc\nd"), few) == "abc\n"
    with pytest.raises(InputLimitError, match="it has more than 4 characters"):
        read_line(io.StringIO("abcde"), few)
    assert list(read_lines(io.BytesIO(b"a\n\nbcd"), few)) == [b"a\n", b"\n", b"bcd"]
    with pytest.raises(InputLimitError):
        list(read_lines(io.BytesIO(b"a\nbcdef"), few))


def test_a_line_is_asked_for_as_python_does(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("one\ntwo"))
    assert [ask_line("> "), ask_line("> ")] == ["one", "two"]
    with pytest.raises(EOFError):
        ask_line("> ")
    assert capsys.readouterr().out == "> > > "


# --- data ----------------------------------------------------------------------------

DEEP = {
    "[" * 100_000: parse_json,
    "[" * (DEPTH + 1) + "]" * (DEPTH + 1): parse_json,
    '{"a":' * (DEPTH + 1) + "1" + "}" * (DEPTH + 1): parse_json,
    "a = " + "[" * 100_000: parse_toml,
    "a." * 50_000 + "a = 1": parse_toml,
}


@pytest.mark.parametrize(("text", "parse"), DEEP.items(), ids=range(len(DEEP)))
def test_data_is_of_some_depth_at_most(
    text: str, parse: Callable[[str], object]
) -> None:
    with pytest.raises(ValueError, match=f"deeper in one another than {DEPTH}"):
        parse(text)


def test_what_is_deep_enough_is_read() -> None:
    text = "[" * DEPTH + "]" * DEPTH
    assert str(parse_json(text)) == text
    assert str(parse_toml(f"a = {text[1:-1]}")["a"]) == text[1:-1]


@pytest.mark.parametrize("parse", [parse_json, lambda it: parse_toml(f"a = {it}")])
def test_a_number_of_six_thousand_digits_is_a_mistake(
    parse: Callable[[str], object],
) -> None:
    with pytest.raises(ValueError, match="4300 digits"):
        parse("9" * 6000)


# --- the commands --------------------------------------------------------------------

COMMANDS = {
    ("check",): "FILE",
    ("show",): "FILE A",
    ("play",): "FILE",
    ("replay",): "FILE",
    ("fracas",): "FILE",
    ("repl",): "FILE",
}


@pytest.mark.parametrize("made", NO_FILES)
@pytest.mark.parametrize(("command", "words"), COMMANDS.items(), ids=str)
@pytest.mark.usefixtures("impatient")
def test_every_command_refuses_in_one_line(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    made: Callable[[Path], Path],
    command: tuple[str, ...],
    words: str,
) -> None:
    file = str(made(tmp_path))
    assert main([*command, *words.replace("FILE", file).split()]) == 2
    out, complaint = capsys.readouterr()
    assert complaint.startswith("ttr: ")
    assert complaint.count("\n") == 1
    assert "developers" not in complaint
    assert not out


def test_a_line_without_end_ends_a_session(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("basic A\n" + "x" * 2 * LINE.most))
    assert main(["repl"]) == 2
    complaint = capsys.readouterr().err
    assert "it has more than 1,000,000 characters" in complaint


def test_an_input_without_end_ends_a_session(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(FACTOR, "0.001")
    monkeypatch.setattr(sys, "stdin", io.StringIO("X := [\n" * 1000))
    assert main(["repl"]) == 2
    assert "it has more than 1,000 characters" in capsys.readouterr().err


def test_a_problem_with_a_number_without_end_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.xml"
    file.write_text(f"<fracas-problems><problem id='{'9' * 6000}'/></fracas-problems>")
    assert main(["fracas", str(file)]) == 2
    assert "has a problem whose id is no number" in capsys.readouterr().err
