"""What is wrong with a study is found before anything is played, all of it at once."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import pytest

from kille.studies.errors import StudyError
from kille.studies.reading import check, checked, parsed

HEAD = "title = 'Trying'\nseeds = 1\n"
REST = """
[tutors.Ann]
kind = "simulated"
[scenes.table]
kind = "{scene}"
[[phases]]
do = "ask"
"""

OWN = """\
from kille.dialogue.meanings import spoken
from kille.dialogue.moves import answering, plan
from ttr import Ind, rectype
from ttr.updates import rule

@rule(when=answering("AskName"))
def admit_name(s):
    "It greets."
    return plan(s, "GreetBack")

@rule(when=rectype(privat=Ind))
def hedge_name(s):
    "It waits for what no state has."
    return s

@rule(when=answering("AskName"))
def assert_name(s):
    "It fails."
    return {}["no idea"]

@rule(when=answering("AskName"))
def greet(s):
    "It greets, whatever it knows."
    return plan(s, "GreetBack")

always = {"assert_name": greet}

class Fine:
    def learn_one(self, x, label): ...
    def predict_proba_one(self, x): return {}

class Odd(Fine):
    def predict_proba_one(self, x): return {"cup": 7}

class Deaf:
    def predict_proba_one(self, x): return {}

class Broken:
    def __init__(self): raise ValueError("no weights")
"""


def packaged(name: str) -> str:
    return files("kille.grammars").joinpath(name).read_text(encoding="utf-8")


def found(tmp_path: Path, theories: str, scene: str = "drawn") -> tuple[str, ...]:
    """What is wrong with theories; their first line is the third of the file."""
    (tmp_path / "own.py").write_text(OWN)
    file = tmp_path / "study.toml"
    file.write_text(HEAD + theories + REST.format(scene=scene))
    try:
        checked(file)
    except StudyError as error:
        return tuple(it.replace(f"{tmp_path}/", "") for it in error.faults)
    return ()


def test_a_study_without_mistakes_is_fine(tmp_path: Path) -> None:
    theories = (
        "[theories.plain]\n"
        "[theories.sure]\nstrategy.bands.sure = 0.5\nwithout = ['hedge_name']\n"
        "[theories.proto]\nlearners = { noun = 'prototype', relation = 'kille' }\n"
        "[theories.own]\nrules = 'own.py:admit_name'\n"
        "[theories.guest]\nlearners.adjective = 'own.py:Fine'\n"
        "[theories.wizard]\nmode = 'person'\n"
        "[theories.svensk]\nlanguage = 'sv'\nwithout = ['hedge_name']\n"
    )
    assert found(tmp_path, theories) == ()


@pytest.mark.parametrize(
    ("theory", "line", "told"),
    [
        ("strategy.bands.sur = 1", 4, "no bands.sur: did you mean sure?"),
        ("strategy.bands.sure = 'x'", 4, "bands.sure of a strategy is a number"),
        ("strategy.bands = 1", 4, "is a table of sure, think"),
        ("strategy.bands.sure = nan", 4, "bands.sure of a strategy is a number"),
        ("strategy.bands.sure = -inf", 4, "bands.sure of a strategy is a number"),
        ("strategy.mode = 'driven'", 4, "the mode of a strategy is that of the theory"),
        ("without = ['hedge']", 4, "no rule hedge: did you mean hedge_name?"),
        ("rules = 'own.py:admit'", 4, "has no admit: did you mean admit_name?"),
        ("rules = 'onw.py:admit'", 4, "no file onw.py: did you mean own.py?"),
        ("rules = 'own'", 4, "rules are named FILE.ttr or FILE.py:NAME, found own"),
        ("learners.noun = 'proto'", 4, "did you mean prototype?"),
        ("learners.noun = 'own.py:Fin'", 4, "has no Fin: did you mean Fine?"),
        ("learners.noun = 'own.py:Deaf'", 4, "a learner needs learn_one"),
        ("learners.noun = 'own.py:Broken'", 4, "ValueError: no weights"),
        ("learners.noun = 'no.such:X'", 4, "there is no module no.such"),
        ("grammar = 'nowhere'", 4, "expected tutor.en.lark or lexicon.en.toml in"),
        ("mode = 'person'\nwithout = ['x']", 5, "a person, who has no without"),
    ],
)
def test_what_cannot_be_used_is_told_where_it_is_named(
    tmp_path: Path, theory: str, line: int, told: str
) -> None:
    [fault] = found(tmp_path, f"[theories.one]\n{theory}\n")
    assert fault.startswith(f"study.toml:{line}: ")
    assert told in fault
    assert "\n" not in fault


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("def (:", "SyntaxError"),
        ("x = noone", "NameError"),
        ("raise SystemExit(2)", "SystemExit: 2"),
    ],
)
def test_code_that_does_not_run_is_told_with_its_line(
    tmp_path: Path, line: str, told: str
) -> None:
    (tmp_path / "odd.py").write_text(f"# rules\n\n{line}\n")
    [fault] = found(tmp_path, "[theories.one]\nrules = 'odd.py:x'\n")
    assert fault.startswith("odd.py:3: ")
    assert told in fault


@pytest.mark.parametrize(
    ("theory", "told"),
    [
        ("rules = 'own.py:assert_name'", "KeyError: 'no idea' (own.py, line 19)"),
        ("rules = 'own.py:assert_name'\nlanguage = 'sv'", "Vad är det här?”: KeyError"),
        ("learners.noun = 'own.py:Odd'", "gave 'cup' the degree 7"),
        ("without = ['say']", "no rule takes the move"),
    ],
)
def test_what_fails_at_a_few_sentences_is_told(
    tmp_path: Path, theory: str, told: str
) -> None:
    [fault] = found(tmp_path, f"[theories.one]\n{theory}\n")
    assert fault.startswith("study.toml:4: tried out, it fails at “")
    assert told in fault


def test_a_rule_that_can_never_fire_is_told_where_it_is_written(tmp_path: Path) -> None:
    [fault] = found(tmp_path, "[theories.one]\nrules = 'own.py:hedge_name'\n")
    assert fault.startswith("own.py:11: ") or fault.startswith("own.py:12: ")
    assert "privat" in fault


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("Sign := [", "Sing := [", "own.ttr:80: nothing is called Sign here"),
        ("Teaching   :=", "Teachings :=", "study.toml:4: tried out, it fails at"),
        ("State := [", "Sate := [", "own.ttr:1: the games cannot be made of it"),
        ("State := [", "check Cue <= Ind\nState := [", "check Cue <= Ind does not"),
    ],
)
def test_meanings_that_the_games_cannot_be_made_of_are_told(
    tmp_path: Path, old: str, new: str, told: str
) -> None:
    source = packaged("tutor.ttr")
    assert old in source
    (tmp_path / "own.ttr").write_text(source.replace(old, new), encoding="utf-8")
    fault, *more = found(tmp_path, "[theories.one]\nmeanings = 'own.ttr'\n")
    assert told in fault
    assert "\n" not in fault
    assert len(more) == (5 if new == "Sing := [" else 0)


def test_nobody_types_to_a_theory_that_is_played_elsewhere(tmp_path: Path) -> None:
    (tmp_path / "own.ttr").write_text(packaged("tutor.ttr"), encoding="utf-8")
    text = f"{HEAD}[theories.one]\nmeanings = 'own.ttr'\n" + REST.format(scene="drawn")
    text += "[tutors.me]\nkind = 'keyboard'\n"
    [told] = check(parsed(text, tmp_path / "study.toml"))
    assert told.endswith(
        "4: me is at the keyboard, and cannot teach a theory that has meanings "
        "of its own"
    )


@pytest.mark.parametrize(
    ("meanings", "line", "told"),
    [
        ("meanings.Itt = '[x : Ind]'", 4, "defines no Itt (did you mean It?)"),
        ("meanings.It = '[x : Idn]'", 4, "nothing is called Idn here"),
        ("meanings.It = '[x : '", 4, "expected"),
        ("meanings.It = 3", 4, "a type is written as a text"),
        ("meanings = 3", 4, "expected a text or a table, found 3"),
        ("[theories.one.meanings]\nNoun = '[x : Ind]'", 5, "it cannot begin: Noun of"),
        ("[theories.one.meanings]\nState = '[x : Ind]'", 4, "is not of its type"),
    ],
)
def test_types_that_are_wrong_are_told_where_they_stand(
    tmp_path: Path, meanings: str, line: int, told: str
) -> None:
    [fault] = found(tmp_path, f"[theories.one]\n{meanings}\n")
    assert fault.startswith(f"study.toml:{line}: ")
    assert told in fault


def test_meanings_that_are_not_there_are_told(tmp_path: Path) -> None:
    [fault] = found(tmp_path, "[theories.one]\nmeanings = 'own.ttr'\n")
    assert fault == "study.toml:4: there is no file own.ttr"


def test_rules_of_the_games_may_have_nothing_left_to_do(tmp_path: Path) -> None:
    theories = (
        "[theories.one]\nrules = 'own.py:always'\n"
        "[theories.two]\nwithout = ['recognise', 'correct']\n"
    )
    assert found(tmp_path, theories) == ()


def test_what_a_theory_file_claims_is_checked_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "tutor.ttr").write_text(packaged("tutor.ttr"), encoding="utf-8")
    own = 'import "tutor.ttr"\n\ncheck Cue <= Rec\ncheck Rec <= Cue\ncheck Cue <= Ind\n'
    (tmp_path / "own.ttr").write_text(own)
    told = found(tmp_path, "[theories.one]\nrules = 'own.ttr'\n")
    assert [it.partition(" does not hold")[0] for it in told] == [
        "own.ttr:4: check Rec <= Cue",
        "own.ttr:5: check Cue <= Ind",
    ]


def test_two_rules_in_place_of_one_are_told(tmp_path: Path) -> None:
    (tmp_path / "tutor.ttr").write_text(packaged("tutor.ttr"), encoding="utf-8")
    rule = 'rule {}(s : State) "" of admit_name := [private : [x : Ind]]\n'
    (tmp_path / "own.ttr").write_text(
        f'import "tutor.ttr"\n{rule.format("silent")}{rule.format("mute")}'
    )
    [fault] = found(tmp_path, "[theories.one]\nrules = 'own.ttr'\n")
    assert "own.ttr: both silent and mute stand in place of admit_name" in fault


def test_a_theory_file_that_does_not_read_is_told_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "own.ttr").write_text("basic A\n\nB := [x : Aa]\n")
    [fault] = found(tmp_path, "[theories.one]\nrules = 'own.ttr'\n")
    assert fault.startswith("own.ttr:3: ")
    assert "did you mean A?" in fault


@pytest.mark.parametrize(
    ("name", "old", "new", "told"),
    [
        ("tutor.en.lark", "start", "start: (\nstrat", "does not read"),
        ("lexicon.en.toml", "[says]", "[says\n", "this lexicon is no TOML"),
        ("lexicon.en.toml", "[phrases]", "[phrase]", "lacks complements"),
        ("lexicon.en.toml", "learned {a_word}", "learned {a_wrd}", "mean a_word?"),
        ("lexicon.en.toml", "learned {a_word}", "learned {a_word", "does not read"),
        ("lexicon.en.toml", "\nexamples = [", "\nexamples = 3\nx = [", "does not read"),
        ("tutor.en.lark", "greet", "greeet", "tutor.ttr has no type for"),
        ("lexicon.en.toml", "admit_name =", "admit_nam =", "no wording for admit_name"),
    ],
)
def test_a_language_that_does_not_read_is_told_in_its_file(
    tmp_path: Path, name: str, old: str, new: str, told: str
) -> None:
    mine = tmp_path / "mine"
    mine.mkdir()
    source = packaged(name)
    assert old in source
    (mine / name).write_text(source.replace(old, new), encoding="utf-8")
    [fault] = found(tmp_path, "[theories.one]\ngrammar = 'mine'\n")
    assert fault.startswith(f"mine/{name}:")
    assert told in fault


def test_learners_are_those_of_the_eyes_that_see_the_scenes(tmp_path: Path) -> None:
    theory = "[theories.one]\nlearners = { noun = 'cues', adjective = 'prototype' }\n"
    [simulated] = found(tmp_path, theory)
    assert "nothing named cues judges nouns of simulated scenes" in simulated
    whole = [it for it in found(tmp_path, theory, "rendered") if "judges" in it]
    assert len(whole) == 1
    assert "nothing named prototype judges adjectives" in whole[0]


def test_mistakes_in_writing_and_in_theories_are_told_at_once(tmp_path: Path) -> None:
    theories = (
        "[theories.one]\nmodee = 'driven'\n"
        "[theories.two]\nwithout = ['hedge']\n"
        "[theories.three]\nlearners.noun = 'proto'\nrules = 'own.py:admit'\n"
    )
    told = found(tmp_path, theories)
    assert [it.split(":")[1] for it in told] == ["4", "6", "9"]


def test_what_tutors_scenes_and_phases_miss_is_told(tmp_path: Path) -> None:
    text = HEAD + "[theories.one]\n" + REST.format(scene="drawn")
    text += "[[phases]]\ndo = 'change_tutor'\nto = 'Bob'\n"
    text += "[tutors.both]\nkind = 'several'\nof = ['Ann', 'Bo']\n"
    told = check(parsed(text, tmp_path / "study.toml"))
    assert any("Bob" in it for it in told)
    assert any("Bo" in it and "both" in it for it in told)
