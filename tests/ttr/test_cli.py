"""The command `ttr`, run on files as a user runs it."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from ttr.cli.main import main

THEORIES = Path(__file__).resolve().parent.parent / "theories"
GOOD = (
    "basic Ind\npred dog(Ind)\nDog := [x : Ind, c : dog(x)]\ncheck Dog <= [x : Ind]\n"
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.ttr").write_text(GOOD)
    (tmp_path / "false.ttr").write_text(GOOD + "check not Dog <= [x : Ind]\n")
    (tmp_path / "wrong.ttr").write_text(GOOD + "Hug := [e : hug(x)]\n")
    return tmp_path


def run(*words: str, **options: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "ttr.cli.main", *words]
    return subprocess.run(  # type: ignore[call-overload,no-any-return]
        command,
        capture_output=True,
        text=True,
        check=False,
        encoding="utf-8",
        **options,
    )


@pytest.mark.parametrize(
    "file", sorted(THEORIES.glob("*.ttr")), ids=lambda file: str(file.name)
)
def test_a_theory_gives_the_output_beside_it(
    file: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(THEORIES)
    code = main(["check", file.name])
    out = capsys.readouterr().out
    assert out == file.with_suffix(".out").read_text(encoding="utf-8")
    *_, last = out.splitlines()
    failed = re.search(r"mistakes?, |checks failed|[0-9] faults? in", last)
    assert (code == 0) == (failed is None)


def test_theories_are_there() -> None:
    assert len(list(THEORIES.glob("*.ttr"))) >= 4


def test_checks_that_hold_take_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "good.ttr"]) == 0
    assert capsys.readouterr().out == "good.ttr: 1 check holds\n"


def test_a_false_claim_exits_with_1(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "good.ttr", "false.ttr"]) == 1
    out = capsys.readouterr().out
    assert "good.ttr: 1 check holds" in out
    assert "false.ttr:5:1" in out
    assert "expected: no\nfound:    yes" in out
    assert out.endswith("false.ttr: 1 of 2 checks failed\n")


def test_a_mistake_exits_with_1(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "wrong.ttr"]) == 1
    out = capsys.readouterr().out
    assert "error: there is no predicate hug" in out
    assert "wrong.ttr:5:13" in out
    assert out.endswith("wrong.ttr: 1 mistake, nothing checked\n")


def test_machines_get_json(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = ["good.ttr", "false.ttr", "wrong.ttr", "none.ttr"]
    assert main(["check", "--json", *files]) == 2
    good, false, wrong, none = json.loads(capsys.readouterr().out)
    assert good == {
        "file": "good.ttr",
        "asked": 1,
        "holds": True,
        "failures": [],
        "rules": 0,
        "faults": [],
        "mistakes": [],
    }
    assert false["failures"][0]["line"] == 5
    assert false["failures"][0]["expected"] == "no"
    assert wrong["mistakes"][0]["column"] == 13
    assert none["mistakes"] == [{"message": "there is no file none.ttr"}]


def test_wrong_use_is_one_line_and_exits_with_2(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words, said in (
        (["check", "none.ttr"], "ttr: there is no file none.ttr\n"),
        (["show", "none.ttr", "Dog"], "ttr: there is no file none.ttr\n"),
        (
            ["show", "good.ttr", "Dgo"],
            "ttr: good.ttr: the theory has no Dgo: did you mean Dog?\n",
        ),
    ):
        assert main(words) == 2
        printed = capsys.readouterr()
        assert (printed.out, printed.err) == ("", said)


@pytest.mark.parametrize("words", [[], ["fly"], ["check"], ["show", "good.ttr"]])
def test_an_unknown_command_exits_with_2(words: list[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(words)
    assert caught.value.code == 2


def test_show_prints_the_statement_that_declares_a_name(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, said in (
        ("Dog", "Dog := [x : Ind, c : dog(x)]\n"),
        ("Ind", "basic Ind\n"),
        ("dog", "pred dog(Ind)\n"),
    ):
        assert main(["show", "good.ttr", name, "--as", "text"]) == 0
        assert capsys.readouterr().out == said


RULES = (
    GOOD
    + """\
object a, b : Ind
Board := [spkr : Ind, addr : Ind]
rule turn(s : Board) "Who was spoken to speaks." := [spkr = s.addr : Ind]
strategy once := maybe(turn)
game talk({spkr = a, addr = b} : Board) := once
"""
)


def test_rules_are_looked_at_and_faults_exit_with_1(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "rules.ttr").write_text(RULES)
    faulty = "rule never(s : Board) := [addr = s.spkr : Ind]\n"
    played = RULES.replace("strategy", f"{faulty}strategy")
    (folder / "faulty.ttr").write_text(
        played.replace("maybe(turn)", "first(turn, never)")
    )
    (folder / "library.ttr").write_text(
        GOOD + "rule none(s : [x : Ind]) := [y : Ind]\n"
    )
    (folder / "start.ttr").write_text(RULES.replace("{spkr = a", "{spkr = 'c'"))
    assert main(["check", "rules.ttr", "library.ttr"]) == 0
    assert capsys.readouterr().out == (
        "rules.ttr: 1 check holds, no fault in 1 rule\n"
        "library.ttr: 1 check holds, no fault in 1 rule\n"
    )
    assert main(["check", "faulty.ttr"]) == 1
    out = capsys.readouterr().out
    assert out.startswith("fault: ")
    assert "┌─ faulty.ttr:8:6\n8 │ rule never(s : Board)" in out
    assert out.endswith("faulty.ttr: 1 check holds, 1 fault in 2 rules\n")
    both = (
        "rule one(s : Board) := [spkr = a : Ind]\n"
        "rule two(s : Board) := [spkr = b : Ind]\n"
    )
    (folder / "doubtful.ttr").write_text(
        RULES.replace("strategy", f"{both}strategy").replace(
            "maybe(turn)", "all(turn, one, two)"
        )
    )
    assert main(["check", "doubtful.ttr"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("warning: the rules one and two")
    assert out.endswith("1 check holds, no fault and 1 warning in 3 rules\n")
    assert main(["check", "--json", "faulty.ttr", "start.ttr"]) == 1
    faulty, start = json.loads(capsys.readouterr().out)
    assert (faulty["rules"], faulty["holds"], faulty["failures"]) == (2, False, [])
    (fault,) = faulty["faults"]
    assert (fault["line"], fault["column"], fault["rule"]) == (8, 6, "never")
    assert (fault["sort"], fault["severity"]) == ("dead", "error")
    assert fault["message"]
    (mistake,) = start["mistakes"]
    assert (mistake["line"], mistake["column"]) == (9, 11)


def test_show_prints_rules_strategies_and_games(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "rules.ttr").write_text(RULES)
    for words, said in (
        (
            ["turn"],
            'rule turn(s : [addr : Ind, spkr : Ind]) "Who was spoken to speaks."\n'
            "    := [spkr = s.addr : Ind]\n",
        ),
        (
            ["turn", "--unfold", "0"],
            'rule turn(s : Board) "Who was spoken to speaks."\n'
            "    := [spkr = s.addr : Ind]\n",
        ),
        (["once"], "strategy once := maybe(turn)\n"),
        (
            ["talk", "--unfold", "0"],
            "game talk({addr = b, spkr = a} : Board) := maybe(turn)\n",
        ),
    ):
        assert main(["show", "rules.ttr", *words]) == 0
        assert capsys.readouterr().out == said
    assert main(["show", "rules.ttr", "turn", "--as", "box"]) == 1
    assert capsys.readouterr().out == (
        "error: turn is shown as text only: it is no type\n"
    )
    assert main(["show", "rules.ttr", "trun"]) == 2
    assert "the theory has no trun: did you mean turn?" in capsys.readouterr().err


def test_show_draws_a_definition(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", "good.ttr", "Dog", "--as", "box"]) == 0
    assert capsys.readouterr().out == "⎡x : Ind   ⎤\n⎣c : dog(x)⎦\n"
    assert main(["show", "good.ttr", "Dog", "--as", "latex"]) == 0
    assert capsys.readouterr().out.startswith("\\left[\\begin{array}")
    assert main(["show", "good.ttr", "Dog", "--as", "html"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("<!DOCTYPE html>")
    assert "<title>Dog</title>" in printed


def test_show_keeps_the_names_of_definitions_on_demand(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "pair.ttr").write_text(
        GOOD + "Pair := [a : Dog, b : Dog]\nPairs := [p : Pair]\n"
    )
    for levels, said in (
        ("0", "[p : Pair]"),
        ("1", "[p : [a : Dog, b : Dog]]"),
        ("2", "[p : [a : [x : Ind, c : dog(x)], b : [x : Ind, c : dog(x)]]]"),
    ):
        assert main(["show", "pair.ttr", "Pairs", "--unfold", levels]) == 0
        assert capsys.readouterr().out == f"Pairs := {said}\n"
    assert main(["show", "pair.ttr", "Pair", "--unfold", "0", "--as", "box"]) == 0
    assert capsys.readouterr().out == "⎡a : Dog⎤\n⎣b : Dog⎦\n"
    with pytest.raises(SystemExit) as caught:
        main(["show", "pair.ttr", "Pair", "--unfold", "-1"])
    assert caught.value.code == 2
    assert "expected 0, 1, 2 or so, found -1" in capsys.readouterr().err


def test_the_command_says_its_version_and_loads_no_parser_for_help() -> None:
    assert run("--version").stdout.startswith("ttr 0.")
    loaded = "import sys; from ttr.cli.main import main\ntry: main(['--help'])\n"
    loaded += "except SystemExit: "
    loaded += "print('lark' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", loaded], capture_output=True, text=True, check=True
    )
    assert "check" in done.stdout
    assert done.stdout.endswith("False\n")


WRONG_USE = {
    ("chek",): "ttr: there is no chek: did you mean check?",
    ("xyz",): "ttr: there is no xyz: try check, play, replay, test, show, repl, lsp, "
    "editor, fracas",
    (): "ttr: a command is missing",
    ("check",): "ttr check: the following arguments are required: FILE",
    ("check", "a", "--jsn"): "ttr check: there is no --jsn: did you mean --json?",
    ("check", "a", "--js"): "ttr check: there is no --js: did you mean --json?",
    ("show", "a", "b", "c"): "ttr show: c is not expected here",
    ("show", "a", "b", "--as", "bx"): "--as: there is no bx: did you mean box?",
    ("test", "a", "--seed", "b"): "--seed: expected a whole number, found b",
    ("play", "a", "--allow", "b\n\x1b"): r"--allow: there is no folder b\n\x1b",
}


@pytest.mark.parametrize(("words", "told"), WRONG_USE.items())
def test_wrong_use_is_one_line_with_a_way_out(
    words: tuple[str, ...], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(words)
    assert caught.value.code == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert told in err
    assert err.count("\n") == 1
    assert err.endswith(" --help says more)\n")


def test_an_interrupt_is_quiet(tmp_path: Path) -> None:
    pipe = tmp_path / "endless.ttr"
    os.mkfifo(pipe)
    command = [sys.executable, "-m", "ttr.cli.main", "check", str(pipe)]
    with subprocess.Popen(command, stdout=-1, stderr=-1) as process:
        with pipe.open("w"):  # opens once the command has opened it to read
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=120)
        assert (process.returncode, out, err) == (130, b"", b"")


def test_a_closed_pipe_is_quiet(folder: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "ttr.cli.main", "check", "good.ttr"]
    done = subprocess.run(command, stdout=writer, stderr=-1, check=False)
    os.close(writer)
    assert done.stderr == b""
    assert done.returncode == 141


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk_is_one_line(folder: Path) -> None:
    command = [sys.executable, "-m", "ttr.cli.main", "check", "good.ttr"]
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(command, stdout=full, stderr=-1, check=False)
    told = b"ttr: the output cannot be written: no space left on device\n"
    assert (done.returncode, done.stderr) == (1, told)


def test_what_a_terminal_cannot_show_is_escaped(folder: Path) -> None:
    plain = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = run("check", "wrong.ttr", env=plain)
    assert done.returncode == 1
    assert "\\u250c" in done.stdout
    assert done.stderr == ""


def test_types_nested_by_definitions_beyond_reach_are_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    steps = [f"T{i} := [x : T{i - 1}]" for i in range(1, 2000)]
    (folder / "deep.ttr").write_text("\n".join(["basic T0", *steps]))
    assert main(["show", "deep.ttr", "T1999"]) == 1
    assert "nested too deep" in capsys.readouterr().err


def test_a_file_of_another_encoding_or_a_folder_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "latin.ttr").write_bytes(b"\xff\xfe\x00")
    assert main(["check", "latin.ttr", "."]) == 2
    assert capsys.readouterr().err == (
        "ttr: latin.ttr is no text: it must be UTF-8\nttr: . is a folder, not a file\n"
    )


MAN = r"""basic Ind
pred man(Ind)
Man := \v:Ind. [e : man(v)]
R := [x : Ind, r : Man(x)]
"""


@pytest.mark.parametrize(
    ("options", "drawn"),
    [
        ((), "⎡x : Ind                      ⎤\n⎣r : (λv:Ind. [e : man(v)])(x)⎦"),
        (("--normal",), "⎡x : Ind         ⎤\n⎣r : [e : man(x)]⎦"),
    ],
)
def test_a_box_shows_what_is_written_or_what_it_computes_to(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    options: tuple[str, ...],
    drawn: str,
) -> None:
    (folder / "man.ttr").write_text(MAN, "utf-8")
    assert main(["show", "--as", "box", *options, "man.ttr", "R"]) == 0
    assert capsys.readouterr().out.strip() == drawn
