"""Consent: no file has anything run, or read and shown, that its user did not mean."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import ttr
from ttr.cli.main import main
from ttr.cli.session.repl import respond
from ttr.cli.session.sessions import Session
from ttr.dialogues.logs import LogError, read_logs
from ttr.dialogues.stories import play, read_stories, setting
from ttr.safety.consent import Consent, NotAllowedError, is_below
from ttr.testing.hash_seeds import first_difference

GAMES = Path(__file__).parent.parent / "games"

SECRET = "root:x:0:0:of nobody's business"

GAME = """
from pathlib import Path
Path(__file__).with_name("ran").touch()
import ttr
game = ttr.load({door!r}).games["door"]
"""


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a story in it, and beside it one with Python that nobody meant."""
    for folder in ("mine", "mine/below", "theirs"):
        (tmp_path / folder).mkdir()
        game = GAME.format(door=str(GAMES / "door.ttr"))
        (tmp_path / folder / "game.py").write_text(game)
    (tmp_path / "mine" / "link.py").symlink_to("../theirs/game.py")
    (tmp_path / "mine" / "linked").symlink_to("../theirs")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def story(home: Path, reference: str) -> Path:
    file = home / "mine" / "visit.dlg"
    file.write_text(
        f"@ game {reference}\n--- a visit\nU> Greet\nS> GreetBack\nS> Ask\n"
    )
    return file


def ran(home: Path) -> list[str]:
    """The folders whose Python was run."""
    return sorted(str(it.parent.relative_to(home)) for it in home.rglob("ran"))


ELSEWHERE = [
    "../theirs/game.py:game",
    "{home}/theirs/game.py:game",
    "below/../../theirs/game.py:game",
    "link.py:game",
    "linked/game.py:game",
    "theirs.game:game",
    "antigravity:game",
    "os.path:join",
]


@pytest.mark.parametrize("reference", ELSEWHERE)
def test_a_story_runs_no_python_from_elsewhere(
    home: Path, reference: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = story(home, reference.format(home=home))
    with pytest.raises(NotAllowedError):
        play(read_stories(file)[0])
    assert main(["play", str(file)]) == 2
    out, err = capsys.readouterr()
    assert err.startswith(f"ttr: {file}:1: ")
    assert (out, err.count("\n"), ran(home)) == ("", 1, [])


@pytest.mark.parametrize("reference", ["game.py:game", "below/../game.py:game"])
def test_a_story_runs_python_from_its_folder(home: Path, reference: str) -> None:
    assert main(["play", "--quiet", str(story(home, reference))]) == 0
    assert ran(home) == ["mine"]


def test_a_story_runs_python_from_below_its_folder(home: Path) -> None:
    assert main(["play", "--quiet", str(story(home, "below/game.py:game"))]) == 0
    assert main(["play", "--quiet", str(story(home, "below.game:game"))]) == 0
    assert ran(home) == ["mine/below"]


def test_a_user_may_allow_more(home: Path) -> None:
    file = str(story(home, "../theirs/game.py:game"))
    assert main(["play", "--quiet", file, "--allow", "theirs"]) == 0
    assert ran(home) == ["theirs"]


def test_a_user_may_name_the_game(home: Path) -> None:
    file = str(story(home, "antigravity:game"))
    assert main(["play", "--quiet", file, "--game", "theirs/game.py:game"]) == 0
    assert ran(home) == ["theirs"]
    door = f"{GAMES}/door.ttr:door"
    assert main(["play", "--quiet", file, "--game", door, "--no-python"]) == 0


def test_a_user_may_refuse_python(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = str(story(home, "game.py:game"))
    for command in (
        ["play", file],
        ["play", file, "--game", "mine/game.py:game"],
        ["test", "mine/game.py:game"],
        ["test", "mine.game:game"],
    ):
        assert main([*command, "--no-python"]) == 2
        told = capsys.readouterr().err
        assert "is Python, which may not be run here" in told
        assert told.count("\n") == 1
    assert ran(home) == []


def test_the_other_stories_are_played(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = str(story(home, "link.py:game"))
    good = str(GAMES / "door.dlg")
    assert main(["play", "--quiet", bad, good, "--junit", "told.xml"]) == 2
    assert capsys.readouterr().out.startswith(f"{good}: ")
    assert 'errors="1"' in (home / "told.xml").read_text()


def test_what_lies_in_the_working_directory_is_not_run(home: Path) -> None:
    """Dialogues are played once more in processes of their own."""
    for module in ("random", "hashlib", "hypothesis", "ttr"):
        (home / f"{module}.py").write_text(GAME.format(door=""))
    place = setting("door.ttr door", GAMES)
    assert first_difference(place, examples=2, start=0) == ""
    assert ran(home) == []


# --- logs ----------------------------------------------------------------------------


@pytest.fixture
def log(home: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """The log of a dialogue with a game in Python."""
    file = home / "mine" / "visit.jsonl"
    played = ["play", "--quiet", str(story(home, "game.py:game")), "--log", str(file)]
    assert main(played) == 0
    (home / "mine" / "ran").unlink()
    capsys.readouterr()
    return file


def test_a_log_runs_nothing(
    home: Path, log: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for options in ([], ["--allow", "mine"], ["--no-python"], ["--from", "1"]):
        assert main(["replay", str(log), *options]) == 2
        out, err = capsys.readouterr()
        told = f"ttr: {log}:1: the log names game.py:game, which is Python, and "
        assert err.startswith(told)
        assert (out, err.count("\n")) == ("", 1)
        assert ("--no-python" in err) == ("--no-python" in options)
        assert ("--game FILE.py:NAME" in err) == ("--no-python" not in options)
    assert ran(home) == []


def test_a_log_is_played_with_the_game_that_a_user_names(
    home: Path, log: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for game in ("theirs/game.py:game", f"{GAMES}/door.ttr:door"):
        assert main(["replay", str(log), "--game", game]) == 0
        assert capsys.readouterr().out == f"{log}: a visit: 1 turn, all the same\n"
    assert ran(home) == ["theirs"]
    refused = ["replay", str(log), "--game", "theirs/game.py:game", "--no-python"]
    assert main(refused) == 2


def test_a_log_may_be_trusted(
    home: Path, log: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replay", str(log), "--trust"]) == 0
    first, second = capsys.readouterr().out.splitlines()
    named = home.resolve() / "mine" / "game.py"
    assert first == f"{log}:1: running {named}, which the log names"
    assert second.endswith("all the same")
    assert ran(home) == ["mine"]
    with pytest.raises(SystemExit):
        main(["replay", str(log), "--trust", "--no-python"])


def test_a_log_of_a_theory_needs_no_consent(home: Path) -> None:
    played = ["play", "--quiet", str(GAMES / "door.dlg"), "--log", "visit.jsonl"]
    assert main(played) == 0
    assert main(["replay", "visit.jsonl", "--no-python"]) == 0


def test_what_a_log_declares_imports_nothing(home: Path, log: Path) -> None:
    (home / "passwd.ttr").write_text(SECRET)
    for name in ("passwd.ttr", str(home / "passwd.ttr"), "/etc/passwd"):
        header, *turns = map(json.loads, log.read_text().splitlines())
        header["declares"].append(f'import "{name}"')
        lines = [f"{json.dumps(line)}\n" for line in (header, *turns)]
        (home / "odd.jsonl").write_text("".join(lines))
        with pytest.raises(LogError, match=r"used here|not used") as caught:
            _ = read_logs(home / "odd.jsonl")[0].declared
        assert "root:x" not in str(caught.value)


# --- theories ------------------------------------------------------------------------


@pytest.fixture
def theories(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A theory with others beside it, below it and elsewhere."""
    for name in ("mine/beside.ttr", "mine/below/under.ttr", "theirs/other.ttr"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("basic Ind\n")
    (tmp_path / "theirs" / "secret").write_text(SECRET)
    (tmp_path / "mine" / "secret").write_text(SECRET)
    (tmp_path / "mine" / "linked.ttr").symlink_to("../theirs/other.ttr")
    (tmp_path / "mine" / "hidden.ttr").symlink_to("secret")
    (tmp_path / "mine" / "away").symlink_to("../theirs")
    os.mkfifo(tmp_path / "mine" / "pipe.ttr")
    (tmp_path / "mine" / "zero.ttr").symlink_to("/dev/zero")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def importing(folder: Path, name: str) -> Path:
    file = folder / "mine" / "top.ttr"
    file.write_text(f'import "{name}"\ncheck Ind <= Ind\nPair := [a : Ind]\n')
    return file


@pytest.mark.parametrize(
    "name", ["beside.ttr", "below/under.ttr", "below/../beside.ttr", "./beside.ttr"]
)
def test_a_theory_imports_from_its_folder(theories: Path, name: str) -> None:
    assert "Ind" in ttr.load(importing(theories, name)).names


@pytest.mark.parametrize(
    "name",
    [
        "../theirs/other.ttr",
        "../theirs/none.ttr",
        "../theirs/secret",
        "linked.ttr",
        "away/other.ttr",
        "hidden.ttr",
        "secret",
        "pipe.ttr",
        "zero.ttr",
        "/etc/passwd",
        "/dev/zero",
        "/proc/self/environ",
    ],
)
def test_a_theory_imports_nothing_else(
    theories: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = str(importing(theories, name))
    with pytest.raises(NotAllowedError) as caught:
        ttr.load(file)
    for command in (["check", file], ["show", file, "Ind"], ["test", file]):
        assert main(command) != 0
    told = "".join((*capsys.readouterr(), str(caught.value)))
    assert "root:x" not in told
    assert "is not used" in told or "--allow" in told


@pytest.mark.parametrize("name", ["mine/secret", "mine/hidden.ttr", "/etc/passwd"])
def test_a_session_tells_nothing_of_what_is_no_theory(
    theories: Path, name: str
) -> None:
    said = respond(Session(), f'import "{name}"').text
    assert "is not used" in said
    assert "root:x" not in said


def test_a_session_imports_what_is_typed_and_what_that_may_import(
    theories: Path,
) -> None:
    (theories / "theirs" / "more.ttr").write_text('import "other.ttr"\nbasic More\n')
    session = respond(Session(), 'import "theirs/more.ttr"').session
    assert session.theory.names >= {"Ind", "More"}
    file = importing(theories, "../theirs/other.ttr")
    assert "--allow" in respond(Session(), f'import "{file}"').text
    assert "--allow" in respond(Session(), f":load {file}").text
    allowed = Session(consent=Consent.of(["theirs"]))
    assert "Ind" in respond(allowed, f":load {file}").session.theory.names


def test_a_theory_imports_from_folders_that_are_allowed(theories: Path) -> None:
    for name in ("../theirs/other.ttr", "linked.ttr", "away/other.ttr"):
        file = importing(theories, name)
        assert "Ind" in ttr.load(file, allow=["theirs"]).names
        assert main(["check", str(file), "--allow", "theirs"]) == 0
        assert main(["show", str(file), "Ind", "--allow", "theirs"]) == 0
    for name in ("../theirs/secret", "secret"):
        file = importing(theories, name)
        with pytest.raises(NotAllowedError, match=r"expected a file called NAME\.ttr"):
            ttr.load(file, allow=["theirs"])


def test_an_import_of_an_import_stays_in_the_folder_of_the_first(
    theories: Path,
) -> None:
    (theories / "mine" / "below" / "under.ttr").write_text('import "../beside.ttr"')
    assert "Ind" in ttr.load(importing(theories, "below/under.ttr")).names
    with pytest.raises(NotAllowedError):
        ttr.load(theories / "mine" / "below" / "under.ttr")
    (theories / "mine" / "beside.ttr").write_text('import "../theirs/other.ttr"')
    with pytest.raises(NotAllowedError):
        ttr.load(importing(theories, "beside.ttr"))


def test_a_text_imports_from_the_working_directory(theories: Path) -> None:
    assert "Ind" in ttr.Theory.parse('import "mine/beside.ttr"').names
    with pytest.raises(NotAllowedError):
        ttr.Theory.parse(f'import "{GAMES}/door.ttr"')


def test_what_is_allowed_is_a_list_of_folders(theories: Path) -> None:
    with pytest.raises(ttr.TTRError, match="allow takes a list of folders"):
        ttr.load("mine/beside.ttr", allow="theirs")
    with pytest.raises(SystemExit):
        main(["check", "mine/beside.ttr", "--allow", "nowhere"])


@pytest.mark.parametrize("name", ["../theirs/other.ttr", "linked.ttr"])
def test_a_story_may_name_a_theory_anywhere(theories: Path, name: str) -> None:
    """Nothing in a theory is run."""
    theory = (GAMES / "door.ttr").read_text()
    (theories / "theirs" / "other.ttr").write_text(theory)
    told = f"@ game {name} door\nU> Greet\nS> GreetBack\nS> Ask\n"
    (theories / "mine" / "a.dlg").write_text(told)
    assert main(["play", "--quiet", "mine/a.dlg", "--no-python"]) == 0


def test_a_story_tells_nothing_of_what_is_no_theory(
    theories: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (theories / "mine" / "a.dlg").write_text("@ game hidden.ttr door\nU> Greet\n")
    assert main(["play", "mine/a.dlg"]) == 2
    assert "root:x" not in "".join(capsys.readouterr())


@pytest.mark.parametrize(
    "name", ["a\0.ttr", "\0", f"{'a' * 5000}.ttr", "\udc80.ttr", "..", "", "loop.ttr"]
)
def test_what_is_no_path_is_told(theories: Path, name: str) -> None:
    (theories / "mine" / "loop.ttr").symlink_to("loop.ttr")
    top = theories / "mine"
    with pytest.raises(ttr.TTRError):
        setting(f"{name} door", top, Consent.of([top]))
    for python in (f"{name[:-4]}.py", name[:-4]):
        with pytest.raises(NotAllowedError):
            Consent.of(["below"]).check_python(python, Path("elsewhere"))


# --- laws ----------------------------------------------------------------------------

NAMES = st.lists(st.sampled_from(["a", "b", "..", ".", "", "link"]), max_size=6)


@given(NAMES)
def test_below_is_where_the_system_says(
    tmp_path_factory: pytest.TempPathFactory, names: list[str]
) -> None:
    """What a path leads to is below a folder if going up from there leads to it."""
    root = tmp_path_factory.getbasetemp() / "law"
    (root / "a" / "b").mkdir(parents=True, exist_ok=True)
    (root / "b").mkdir(exist_ok=True)
    for link, to in ((root / "a" / "link", "../b"), (root / "b" / "link", "../a/b")):
        if not link.is_symlink():
            link.symlink_to(to)
    path, folder = Path(root, *names), root / "a"
    if not path.is_dir():
        return
    above = [path, *(path / "/".join([".."] * n) for n in range(1, 30))]
    assert is_below(path, folder) == any(it.samefile(folder) for it in above)


def test_consent_to_folders_adds_up() -> None:
    consent = Consent.of(["a"])
    assert consent.with_folders("a") == consent
    assert consent.with_folders("b") == Consent.of(["a", "b"])
