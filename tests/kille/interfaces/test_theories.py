"""`kille init`, and `kille talk --theory` with what it made, a file and a study."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import pytest

from kille.interfaces.theories import maker_of
from ttr.safety.consent import OWN_FOLDER

from .conftest import Run

EMPTY = "synthetic:empty?seed=3"

NAMES = {
    "en": ["lexicon.en.toml", "strategies.toml", "tutor.en.lark", "tutor.ttr"],
    "sv": ["lexicon.sv.toml", "strategies.toml", "tutor.sv.lark", "tutor.ttr"],
}

STUDY = """\
title = "Greetings"
seeds = 1
[theories.usual]
[theories.bold]
meanings = "mine.ttr"
wording = "four"
[theories.Eve]
mode = "person"
[theories.python]
rules = "own.py:RULES"
[tutors.Ann]
kind = "simulated"
[scenes.table]
kind = "around"
[[phases]]
do = "teach"
"""


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def answers(kille: Run, theory: Path | str, *texts: str, lang: str = "en") -> list[str]:
    """What the robot of a theory answers."""
    typed = "".join(f"{text}\n" for text in texts)
    done = kille(
        "talk",
        *("--sensor", EMPTY, "--theory", str(theory), "--lang", lang),
        typed=typed,
    )
    assert (done.code, done.err) == (0, "")
    return [line[3:] for line in done.out.splitlines() if line.startswith("S> ")]


@pytest.fixture
def mine(kille: Run, tmp_path: Path) -> Path:
    folder = tmp_path / "mine"
    assert kille("init", str(folder)).code == 0
    return folder


@pytest.mark.parametrize("language", NAMES)
def test_what_is_copied_is_what_the_package_has(
    kille: Run, tmp_path: Path, language: str
) -> None:
    folder = tmp_path / "a folder" / "mine"
    done = kille("init", str(folder), "--lang", language)
    assert (done.code, done.err) == (0, "")
    assert sorted(it.name for it in folder.iterdir()) == NAMES[language]
    for name in NAMES[language]:
        packaged = files("kille.grammars").joinpath(name).read_bytes()
        assert (folder / name).read_bytes() == packaged
    learned = next(
        line
        for line in (folder / NAMES[language][0]).read_text("utf-8").splitlines()
        if line.startswith("learned = ")
    )
    assert learned in done.out
    assert f"kille talk --theory '{folder}'" in done.out
    assert ("--lang sv" in done.out) == (language == "sv")


def test_a_folder_that_is_there_is_left_as_it_is(kille: Run, mine: Path) -> None:
    (mine / "tutor.ttr").write_text("changed")
    done = kille("init", str(mine))
    assert (done.code, done.out) == (2, "")
    assert done.err == f"kille: {mine} is not empty: name a new folder\n"
    assert (mine / "tutor.ttr").read_text() == "changed"


def test_a_file_is_no_folder(kille: Run, tmp_path: Path) -> None:
    (tmp_path / "mine").write_text("")
    done = kille("init", str(tmp_path / "mine"))
    assert (done.code, done.err.count("\n")) == (2, 1)
    assert "is a file: name a new folder" in done.err
    done = kille("init", str(tmp_path / "mine" / "below"))
    assert (done.code, done.err.count("\n")) == (1, 1)
    assert "cannot be written" in done.err


def test_an_empty_folder_will_do(kille: Run, tmp_path: Path) -> None:
    assert kille("init", str(tmp_path)).code == 0
    assert sorted(it.name for it in tmp_path.iterdir())[-1] == "tutor.ttr"


def test_the_robot_says_what_was_changed_in_the_folder(kille: Run, mine: Path) -> None:
    assert answers(kille, mine, "Hello.") == ["Hello."]
    change(mine / "lexicon.en.toml", 'greet_back = "Hello."', 'greet_back = "Hi!"')
    change(mine / "tutor.ttr", "e : welcome(spkr, addr)", "e : part(spkr, addr)")
    said = answers(kille, mine, "Hello.", "Thank you.")
    assert said == ["Hi!", "Goodbye."]


def test_it_understands_what_was_added_to_the_grammar(kille: Run, mine: Path) -> None:
    change(mine / "tutor.en.lark", "_ME: /me\\b/i", "_ME: /me\\b/i\n_NAME: /name\\b/i")
    change(
        mine / "tutor.en.lark",
        "| _WHAT _DO _YOU _CALL asked\n",
        "| _WHAT _DO _YOU _CALL asked\n         | _NAME asked\n",
    )
    assert answers(kille, mine, "Name this!") == ["I see nothing on the table."]


def test_what_is_deleted_is_that_of_the_package(kille: Run, mine: Path) -> None:
    for name in NAMES["en"][1:]:
        (mine / name).unlink()
    change(mine / "lexicon.en.toml", 'greet_back = "Hello."', 'greet_back = "Hi!"')
    assert answers(kille, mine, "Hello.", "Thank you.") == ["Hi!", "You are welcome."]
    (mine / "lexicon.en.toml").unlink()
    done = kille("talk", "--sensor", EMPTY, "--theory", str(mine), typed="Hello.\n")
    assert done.code == 2
    assert "`kille init` writes them" in done.err


def test_the_strategies_of_the_folder_decide(
    kille: Run, mine: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    change(mine / "strategies.toml", 'wording = "paper"', 'wording = "four"')
    monkeypatch.chdir(mine)
    assert answers(kille, ".", "Hello.") == ["Hello."]
    (mine / "strategies.toml").write_text("[wordings]\n")
    done = kille("talk", "--sensor", EMPTY, "--theory", ".", typed="Hello.\n")
    assert (done.code, done.out, done.err.count("\n")) == (2, "", 1)
    assert "strategies.toml:1: these strategies lack default, which" in done.err


RULES = """\
from kille.dialogue.rules import reply
RULES = {"GreetBack to Greet": reply("Greet", "Part", "It does not stay to talk.")}
"""


def test_the_rules_of_the_folder_are_played(kille: Run, mine: Path) -> None:
    (mine / "rules.py").write_text(RULES)
    assert answers(kille, mine, "Hello.") == ["Goodbye."]
    for name in NAMES["en"]:
        (mine / name).unlink()
    assert answers(kille, mine, "Hello.") == ["Goodbye."]


def test_the_rules_of_the_folder_need_consent(kille: Run, mine: Path) -> None:
    (mine / "rules.py").write_text(f"open('ran', 'w')\n{RULES}")
    done = kille("talk", "--theory", str(mine), "--no-python", typed="Hello.\n")
    assert (done.code, done.out) == (2, "")
    assert "rules.py is Python, which may not be run here" in done.complaint
    assert not (mine / "ran").exists()


def test_swedish_is_spoken_by_a_folder_of_its_own(kille: Run, tmp_path: Path) -> None:
    folder = tmp_path / "min"
    kille("init", str(folder), "--lang", "sv")
    change(folder / "lexicon.sv.toml", 'greet_back = "Hej."', 'greet_back = "Tjena!"')
    assert answers(kille, folder, "Hej.", lang="sv") == ["Tjena!"]


# --- files and studies ---------------------------------------------------------------


@pytest.fixture
def study(mine: Path) -> Path:
    """A study of which one theory has it that a greeting is a farewell."""
    change(mine / "tutor.ttr", "e : greet_back(spkr, addr)", "e : part(spkr, addr)")
    (mine / "tutor.ttr").rename(mine / "mine.ttr")
    (mine / "own.py").write_text(
        "from pathlib import Path\n"
        "Path(__file__).with_name('ran').touch()\n"
        "RULES = []\n"
    )
    (mine / "study.toml").write_text(STUDY)
    return mine / "study.toml"


def test_a_file_of_types_is_a_theory(kille: Run, study: Path) -> None:
    assert answers(kille, study.parent / "mine.ttr", "Hello.") == ["Goodbye."]


def test_a_theory_of_a_study_talks(kille: Run, study: Path) -> None:
    assert answers(kille, f"{study}:bold", "Hello.") == ["Goodbye."]
    assert answers(kille, f"{study}:usual", "Hello.") == ["Hello."]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("study.toml:blod", "has no theory blod: did you mean bold?"),
        ("study.toml:Eve", "is played by a person: name another"),
        ("stduy.toml:bold", "there is no file"),
        ("mien.ttr", "there is no file"),
        ("own.py", "is no theory: expected FILE.ttr, a folder or STUDY.toml:NAME"),
        ("", "is no theory"),
    ],
)
def test_what_is_no_theory_is_told_in_a_line(
    kille: Run, study: Path, name: str, told: str
) -> None:
    named = str(study.parent / name) if name else "nowhere"
    done = kille("talk", "--sensor", EMPTY, "--theory", named, typed="Hello.\n")
    assert (done.code, done.out, done.err.count("\n")) == (2, "", 1)
    assert told in done.err


def test_all_that_is_wrong_with_types_is_told_before_it_talks(
    kille: Run, study: Path
) -> None:
    file = study.parent / "mine.ttr"
    change(file, "Phrase    := [x : Ind,", "Phrase    := [x : Idn,")
    done = kille("talk", "--sensor", EMPTY, "--theory", str(file), typed="Hello.\n")
    assert (done.code, done.out) == (2, "")
    assert "mine.ttr:25: nothing is called Idn here" in done.err


def test_python_of_a_study_is_run_only_with_consent(kille: Run, study: Path) -> None:
    named = f"{study}:usual"
    done = kille(
        "talk", "--sensor", EMPTY, "--theory", named, "--no-python", typed="Hello.\n"
    )
    assert done.code == 2
    assert "own.py" in done.err
    assert not (study.parent / "ran").exists()


# --- other commands that have a robot ------------------------------------------------


def test_stories_are_played_to_the_robot_of_a_theory(
    kille: Run, study: Path, tmp_path: Path
) -> None:
    story = tmp_path / "greeting.dlg"
    story.write_text("U> Hello.\nS> Goodbye.\n")
    assert kille("replay", str(story)).code == 1
    for named in (study.parent / "mine.ttr", f"{study}:bold"):
        done = kille("replay", str(story), "--theory", str(named))
        assert (done.code, done.err) == (0, "")


def test_a_story_is_played_by_the_defaults_of_a_folder(mine: Path) -> None:
    change(mine / "strategies.toml", 'wording = "paper"', 'wording = "four"')
    change(mine / "strategies.toml", 'mode = "assisted"', 'mode = "driven"')
    with maker_of(str(mine), OWN_FOLDER, "en")(EMPTY, None) as robot:
        strategy = robot.state.private.strategy
    assert (strategy.wording, strategy.mode) == ("four", "driven")


def test_a_story_is_played_in_its_own_language(
    kille: Run, study: Path, tmp_path: Path
) -> None:
    for name, text in (("a.dlg", "Hello."), ("a.sv.dlg", "Hej.")):
        (tmp_path / name).write_text(f"U> {text}\nS~ ...\n")
    mine, stories = str(study.parent / "mine.ttr"), ("a.dlg", "a.sv.dlg")
    done = kille("replay", *(str(tmp_path / it) for it in stories), "--theory", mine)
    assert "Goodbye." in done.out
    assert "Hej då." in done.out
    done = kille("replay", str(tmp_path / "a.sv.dlg"), "--theory", f"{study}:bold")
    assert (done.code, done.complaint) == (2, f"kille: {study}:bold speaks en, not sv")


def test_a_story_cannot_be_played_to_what_is_no_theory(
    kille: Run, study: Path, tmp_path: Path
) -> None:
    story = tmp_path / "greeting.dlg"
    story.write_text("U> Hello.\nS> Goodbye.\n")
    done = kille("replay", str(story), "--theory", f"{study}:blod")
    assert (done.code, done.out) == (2, "")
    assert "has no theory blod: did you mean bold?" in done.complaint


def test_a_move_that_leaves_open_what_is_done_can_be_asked_about(kille: Run) -> None:
    # The rule `nod` plans to say something, and nothing else.
    study = Path(__file__).parents[3] / "examples/studies/protocols/rules.toml"
    said = ("@ show cup", "No, this is a mug.", "Why?", "How sure are you?", "No.")
    found = answers(kille, f"{study}:nods", *said)
    assert len(found) == 4
    assert found[1:3] == ["I have not claimed anything."] * 2


# --- a move of one's own --------------------------------------------------------------

OWN_RULES = """\
from kille.dialogue.games import games_with
from kille.dialogue.rules import reply

RULES = games_with(reply("Dismiss", "Drop", "The claim is dropped."))
"""


@pytest.fixture
def skip_theory(mine: Path) -> Path:
    """The folder with the new move of `docs/how-to/change-what-it-says.md`."""
    change(
        mine / "tutor.ttr",
        "\nLeave ",
        "\npred dismiss(Ind, Ind), drop(Ind, Ind)\n"
        "Dismiss    := [spkr : Ind, addr : Ind, e : dismiss(spkr, addr)]\n"
        "Drop       := [spkr : Ind, addr : Ind, e : drop(spkr, addr)]\n"
        "Leave ",
    )
    grammar = mine / "tutor.en.lark"
    change(grammar, "| leave | okay\n", "| leave | okay | dismiss\n")
    change(grammar, "\nleave: _BYE\n", "\nleave: _BYE\ndismiss: _SKIP _IT\n")
    change(grammar, "\n_ME: ", "\n_SKIP: /skip\\b/i\n_ME: ")
    change(mine / "lexicon.en.toml", "\npart = ", '\ndrop = "All right."\npart = ')
    (mine / "rules.py").write_text(OWN_RULES)
    return mine


def test_a_move_of_ones_own_is_understood_and_answered(
    kille: Run, skip_theory: Path
) -> None:
    assert answers(kille, skip_theory, "Skip it.") == ["All right."]


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        (
            "tutor.en.lark",
            "okay | dismiss\n",
            "okay | dismis\n",
            "does not read: there is no rule dismis, which _request uses: did you mean "
            "dismiss?",
        ),
        (
            "tutor.en.lark",
            "\n_SKIP:",
            "\n_SKP:",
            "does not read: there is no token _SKIP, which dismiss uses",
        ),
        (
            "tutor.en.lark",
            "dismiss: _SKIP",
            "dismiss _SKIP",
            "does not read: expected a colon, found _SKIP",
        ),
        (
            "tutor.en.lark",
            "dismiss: _SKIP",
            "dismiss: (_SKIP",
            "does not read: expected ), found the end of the line",
        ),
        (
            "tutor.en.lark",
            "/skip\\b/i",
            "skip\\b/i",
            "does not read: \\b/i cannot stand there",
        ),
        (
            "tutor.en.lark",
            "dismiss: _SKIP _IT\n",
            "dismiss: _SKIP _IT\nleave: _BYE\n",
            "does not read: the rule leave is defined on line ",
        ),
        (
            "lexicon.en.toml",
            "\ndrop =",
            "\ndrp =",
            "there is no move drp, which this is a wording of: did you mean drop?",
        ),
        (
            "lexicon.en.toml",
            '\ndrop = "All right."',
            "",
            "there is no wording of drop, by which Drop is said",
        ),
        (
            "strategies.toml",
            "assert = {",
            "assrt = {",
            "wordings.paper.stakes has no assrt: did you mean assert?",
        ),
        (
            "strategies.toml",
            "right = 1.0",
            'right = "one"',
            'wordings.paper.stakes.assert.right: expected a number, found "one"',
        ),
        ("strategies.toml", "right = 1.0", "right = one", "no TOML: Invalid value"),
        (
            "rules.py",
            '"Dismiss"',
            '"Dismis"',
            "has no Dismis: did you mean Dismiss?, which a rule names",
        ),
        ("rules.py", '"Drop"', '"Dropp"', "has no Dropp: did you mean Drop?"),
    ],
)
def test_a_mistake_in_it_is_told_on_its_line(
    kille: Run, skip_theory: Path, file: str, old: str, new: str, told: str
) -> None:
    change(skip_theory / file, old, new)
    done = kille("talk", "--sensor", EMPTY, "--theory", str(skip_theory), typed="")
    assert done.code == 2
    place = f"kille: {skip_theory / file}:"
    [line] = [it for it in done.err.splitlines() if told in it]
    assert line.startswith(place)
    number = int(line.removeprefix(place).partition(":")[0])
    text = (skip_theory / file).read_text("utf-8").splitlines()[number - 1 : number + 1]
    shown = (new.strip() or "[says]").splitlines()[-1]
    assert shown in "\n".join(text) or "token _SKIP" in told


def test_rules_about_types_that_are_not_there_are_told(
    kille: Run, skip_theory: Path
) -> None:
    (skip_theory / "tutor.ttr").unlink()
    done = kille("talk", "--sensor", EMPTY, "--theory", str(skip_theory), typed="")
    assert (done.code, done.err.splitlines()[-1]) == (
        2,
        f"kille: {skip_theory}/rules.py:4: the theory has no Drop, which a rule names",
    )


def test_a_file_that_nothing_reads_is_told(kille: Run, mine: Path) -> None:
    (mine / "tutor.en.lark").rename(mine / "tutor.eng.lark")
    done = kille("talk", "--sensor", EMPTY, "--theory", str(mine), typed="")
    assert (done.code, done.err) == (
        2,
        f"kille: nothing reads {mine}/tutor.eng.lark: did you mean tutor.en.lark?\n",
    )


def test_a_move_without_a_wording_is_told_and_the_talk_goes_on(
    kille: Run, skip_theory: Path
) -> None:
    """Whose language has no lexicon of one's own is not refused: few moves are said."""
    (skip_theory / "lexicon.en.toml").unlink()
    done = kille(
        "talk",
        *("--sensor", EMPTY, "--theory", str(skip_theory)),
        typed="Skip it.\nHello.\n",
    )
    [told] = done.err.splitlines()
    assert told == (
        "kille: there is no wording of drop: write one under [says] in lexicon.en.toml"
    )
    assert done.out.splitlines()[-1].startswith("S> Hello")
