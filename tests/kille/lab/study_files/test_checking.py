"""What is wrong with a study is found before anything is played, all of it at once."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from shutil import copytree

import cv2
import numpy as np
import pytest

from kille.lab.errors import StudyError
from kille.lab.study_files import check, parse, read_and_check
from kille.sensors.captures import read_sequence

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
from kille.dialogue.meanings import move_type
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

class Shy(Fine):
    def learn_one(self, x, label): raise ValueError("no")

def leaves(games):
    raise SystemExit(2)
"""


def packaged(name: str) -> str:
    return files("kille.grammars").joinpath(name).read_text(encoding="utf-8")


def found(tmp_path: Path, theories: str, scene: str = "drawn") -> tuple[str, ...]:
    """What is wrong with theories; their first line is the third of the file."""
    (tmp_path / "own.py").write_text(OWN)
    (tmp_path / "folder.py").mkdir(exist_ok=True)
    file = tmp_path / "study.toml"
    file.write_text(HEAD + theories + REST.format(scene=scene))
    try:
        read_and_check(file)
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
        ("strategy.bands.sure = 'x'", 4, "bands.sure of a strategy: expected a number"),
        ("strategy.bands = 1", 4, "is a table of sure, think"),
        ("strategy.bands.sure = true", 4, "from 0 to 2, found true"),
        ("strategy.bands.sure = 95", 4, "expected a number from 0 to 2, found 95"),
        ("strategy.hearing.strange = -1", 4, "hearing.strange of a strategy: expecte"),
        ("strategy.wants.asking = [1, 2]", 4, "found a list"),
        ("strategy.wants.learning = true", 4, "a table of right, wrong, found true"),
        ("strategy.bands.sure = nan", 4, "bands.sure of a strategy: expected a number"),
        (
            "strategy.bands.sure = -inf",
            4,
            "bands.sure of a strategy: expected a number",
        ),
        ("strategy.mode = 'driven'", 4, "the mode of a strategy is that of the theory"),
        ("without = ['hedge']", 4, "no rule hedge: did you mean hedge_name?"),
        ("rules = 'own.py:admit'", 4, "has no admit: did you mean admit_name?"),
        ("rules = 'onw.py:admit'", 4, "no file onw.py: did you mean own.py?"),
        ("rules = 'folder.py:x'", 4, "folder.py is a folder, not a file"),
        ("rules = 'own'", 4, "rules are named FILE.ttr or FILE.py:NAME, found own"),
        ("learners.noun = 'proto'", 4, "did you mean prototype?"),
        ("learners.noun = ''", 4, 'nothing named "" judges nouns'),
        ("learners.noun = 'own.py'", 4, "write what it is called in the file, own.py:"),
        ("learners.noun = 'onw.py:Fine'", 4, "no file onw.py: did you mean own.py?"),
        ("learners.noun = 'folder.py:X'", 4, "folder.py is a folder, not a file"),
        ("learners.noun = 'own.py:Fin'", 4, "has no Fin: did you mean Fine?"),
        ("learners.noun = 'own.py:Deaf'", 4, "a learner needs learn_one"),
        ("learners.noun = 'no.such:X'", 4, "there is no module no.such"),
        ("grammar = 'nowhere'", 4, "there is no folder nowhere"),
        ("grammar = 'own.py'", 4, "is a file, not a folder: name the folder that it"),
        ("grammar = '.'", 4, "expected tutor.en.lark or lexicon.en.toml in"),
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
@pytest.mark.parametrize("key", ["rules", "learners.noun"])
def test_code_that_does_not_run_is_told_with_its_line(
    tmp_path: Path, key: str, line: str, told: str
) -> None:
    (tmp_path / "odd.py").write_text(f"# mine\n\n{line}\n")
    [fault] = found(tmp_path, f"[theories.one]\n{key} = 'odd.py:x'\n")
    assert fault.startswith("odd.py:3: ")
    assert told in fault


def test_a_function_of_the_games_that_leaves_is_told_with_its_line(
    tmp_path: Path,
) -> None:
    [fault] = found(tmp_path, "[theories.one]\nrules = 'own.py:leaves'\n")
    assert fault.startswith("own.py:45: own.py:leaves failed: SystemExit: 2")


def test_all_rules_that_are_not_there_are_told_where_they_are_named(
    tmp_path: Path,
) -> None:
    own = "[theories.one]\nrules = 'own.py:admit_name'\nwithout = ['hedg', 'assrt']\n"
    assert [it.partition(" rule ")[2][:5] for it in found(tmp_path, own)] == [
        "hedg:",
        "assrt",
    ]
    assert all(it.startswith("study.toml:5: ") for it in found(tmp_path, own))


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("Broken", "own.py:39: the method own.py:Broken failed: it cannot be made: V"),
        ("Odd", "study.toml:4: the method own.py:Odd failed: predict_proba_one gave"),
        ("Shy", "own.py:42: the method own.py:Shy failed: learn_one: ValueError: no"),
        ("Fine", ""),
    ],
)
@pytest.mark.parametrize("kind", ["noun", "relation"])
def test_a_learner_for_the_robots_own_eyes_is_given_a_lesson(
    tmp_path: Path, kind: str, name: str, told: str
) -> None:
    """What fails at a lesson fails in every dialogue, and each of them takes long."""
    theory = f"[theories.one]\nlearners.{kind} = 'own.py:{name}'\n"
    faults = found(tmp_path, theory, "rendered")
    assert len(faults) == bool(told)
    assert "".join(faults).startswith(told)


@pytest.mark.parametrize(
    ("theory", "told"),
    [
        ("rules = 'own.py:assert_name'", "KeyError: 'no idea' (own.py, line 19)"),
        ("rules = 'own.py:assert_name'\nlanguage = 'sv'", "Vad är det här?”: KeyError"),
        ("learners.noun = 'own.py:Odd'", "gave 'cup' the degree 7"),
        ("learners.adjective = 'own.py:Odd'", "gave 'cup' the degree 7"),
        ("learners.adjective = 'own.py:Shy'\nlanguage = 'sv'", "ValueError: no"),
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
        ("Sign := [", "Sing := [", "own.ttr:{heard}: nothing is called Sign here"),
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
    heard = source[: source.index(": list(Sign)")].count("\n") + 1
    assert told.format(heard=heard) in fault
    assert "\n" not in fault
    assert len(more) == (8 if new == "Sing := [" else 0)


def test_people_may_type_to_a_theory_with_meanings(tmp_path: Path) -> None:
    (tmp_path / "own.ttr").write_text(packaged("tutor.ttr"), encoding="utf-8")
    text = f"{HEAD}[theories.one]\nmeanings = 'own.ttr'\n" + REST.format(scene="drawn")
    text += "[tutors.me]\nkind = 'keyboard'\n"
    assert check(parse(text, tmp_path / "study.toml")) == ()


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
    (tmp_path / "own.ttr").mkdir()
    [fault] = found(tmp_path, "[theories.one]\nmeanings = 'own.ttr'\n")
    assert fault == "study.toml:4: own.ttr is a folder, not a file"


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


def test_a_long_mistake_is_told_from_its_beginning_to_its_end(tmp_path: Path) -> None:
    """What is left out is in the middle: the end says what is wrong with the type."""
    (tmp_path / "tutor.ttr").write_text(packaged("tutor.ttr"), encoding="utf-8")
    rule = (
        "rule silent(s : State) of admit_name\n"
        "    := [private : [agenda = [Said /\\ Acknowledge] : Agenda]]\n"
    )
    (tmp_path / "own.ttr").write_text(f'import "tutor.ttr"\n{rule}')
    [fault] = found(tmp_path, "[theories.one]\nrules = 'own.ttr'\n")
    assert fault.startswith("own.ttr:3: the rule silent sets private.agenda to [[addr")
    assert " … " in fault
    assert "which is no list(RecType^1): a meet of record types" in fault


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
        ("lexicon.en.toml", "\nsame_thing = ", "\nsame_thng = ", "mean same_thing?"),
        ("lexicon.en.toml", "\nsame_thing = ", "\n#", "no wording for same_thing"),
        ("lexicon.en.toml", "[says_four]", "[says_four]\nmine = [{}]", "found a table"),
        (
            "lexicon.en.toml",
            "[says_four]",
            "[says_four]\nmine = [[]]",
            "found a list in a list",
        ),
        ("lexicon.en.toml", "[says_four]", "[says_four]\nmine = true", "found true"),
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


@pytest.mark.parametrize(
    ("only", "told"),
    [
        ("", "mine/tutor.en.lark:1: this grammar cannot be used for “This is to the"),
        ("(?=.*right)", 'study.toml:4: this grammar cannot be used for lessons in "'),
    ],
)
def test_a_grammar_that_takes_years_for_a_sentence_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, only: str, told: str
) -> None:
    monkeypatch.setattr("kille.dialogue.parsing.SECONDS", 0.5)
    (tmp_path / "mine").mkdir()
    slow = rf"%ignore /{only}(?=([^q]|[^q][^q])+q)/"
    own = f"{packaged('tutor.en.lark')}\n{slow}\n"
    (tmp_path / "mine" / "tutor.en.lark").write_text(own, encoding="utf-8")
    [fault] = found(tmp_path, "[theories.one]\ngrammar = 'mine'\n")
    assert told in fault
    assert "what is ignored takes too long to look for" in fault


def test_a_swedish_grammar_is_tried_in_swedish(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    source = packaged("tutor.sv.lark")
    assert "greet" in source
    own = source.replace("greet", "greeet")
    (tmp_path / "mine" / "tutor.sv.lark").write_text(own, encoding="utf-8")
    theory = "[theories.one]\ngrammar = 'mine'\n"
    [fault] = found(tmp_path, f"{theory}language = 'sv'\n")
    assert "this grammar makes of “Hej.” what tutor.ttr has no type for" in fault
    [fault] = found(tmp_path, theory)
    assert fault.endswith('found neither, but files of language = "sv"')


def test_learners_are_those_of_the_eyes_that_see_the_scenes(tmp_path: Path) -> None:
    theory = "[theories.one]\nlearners = { noun = 'both', adjective = 'prototype' }\n"
    [simulated] = found(tmp_path, theory)
    assert 'nothing named "both" judges nouns of simulated scenes' in simulated
    whole = [it for it in found(tmp_path, theory, "rendered") if "judges" in it]
    assert len(whole) == 1
    assert 'nothing named "prototype" judges adjectives' in whole[0]


def test_mistakes_in_writing_and_in_theories_are_told_at_once(tmp_path: Path) -> None:
    theories = (
        "[theories.one]\nmodee = 'driven'\n"
        "[theories.two]\nwithout = ['hedge']\n"
        "[theories.three]\nlearners.noun = 'proto'\nrules = 'own.py:admit'\n"
    )
    told = found(tmp_path, theories)
    assert [it.split(":")[1] for it in told] == ["4", "6", "8", "9"]


WHOLE = """\
title = "Trying"
seeds = 1
[theories.one]
[theories.two]
without = ["hedge_name"]
[tutors.Ann]
kind = "simulated"
[tutors.Bo]
kind = "simulated"
[scenes.table]
kind = "drawn"
kinds = ["cup", "mug", "book"]
each = 2
[[phases]]
do = "teach"
[[phases]]
do = "ask"
of = "new"
"""


def wrong(folder: Path, *changes: tuple[str, str]) -> list[str]:
    """What is wrong with a study that is fine but for these changes."""
    text = WHOLE
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "study.toml").write_text(text, encoding="utf-8")
    try:
        read_and_check(folder / "study.toml")
    except StudyError as error:
        return [it.replace(f"{folder}/", "") for it in error.faults]
    return []


ANN = '[tutors.Ann]\nkind = "simulated"'


def test_mistakes_of_all_sorts_are_told_at_once(tmp_path: Path) -> None:
    """Those in writing, and those of what is written well but does not fit."""
    told = wrong(
        tmp_path,
        ("seeds = 1", "seeds = -1"),
        ('["hedge_name"]', '["hedge"]'),
        (ANN, f'{ANN}\nerors = 1\n[tutors.Cy]\nkind = "several"\nof = ["Bob", "Ann"]'),
        ('["cup", "mug", "book"]', "[]"),
        ('do = "teach"', 'do = "tech"'),
        ('do = "ask"', 'do = "swap"\nto = "Bob"\n[[phases]]\ndo = "ask"'),
    )
    assert [it.split(": ")[0] for it in told] == [
        f"study.toml:{line}" for line in (2, 5, 8, 11, 16, 19, 22)
    ]


def test_what_is_written_wrongly_is_no_mistake_of_others(tmp_path: Path) -> None:
    """A tutor, scenes or a phase with a slip in it are there nevertheless."""
    told = wrong(
        tmp_path,
        ("[tutors.Bo]\nkind", "[tutors.Bo]\nknd"),
        ('kind = "drawn"', 'kind = "drawm"'),
        ('do = "teach"', 'do = "teach"\nwat = "nouns"'),
        ('do = "ask"', 'do = "swap"\nto = "Bo"\n[[phases]]\ndo = "ask"'),
        (ANN, f'{ANN}\ncalls = {{ spoon = "ladle" }}'),
    )
    assert [it.split(": ")[0] for it in told] == [
        f"study.toml:{line}" for line in (10, 12, 17)
    ]


@pytest.mark.parametrize(
    "lines", ['language = "sv"\nlerners = 1', 'language = "svenska"']
)
def test_words_of_a_theory_with_a_slip_in_it_are_words(
    tmp_path: Path, lines: str
) -> None:
    """What is Swedish for a cup is no mistake because the theory has one."""
    told = wrong(
        tmp_path,
        ("[theories.one]", f"[theories.one]\n{lines}"),
        (ANN, f'{ANN}\nvocabulary = ["kopp"]'),
        ('do = "ask"\nof = "new"', 'do = "forget"\nwords = ["kopp"]'),
    )
    assert len(told) == 1
    assert "one" in told[0]


def test_where_the_number_of_turns_has_a_slip_all_phases_are_reached(
    tmp_path: Path,
) -> None:
    [fault] = wrong(
        tmp_path,
        ("seeds = 1", 'seeds = 1\nturns = "9000"'),
        ('do = "teach"', 'do = "teach"\nrounds = 800'),
    )
    assert fault.startswith("study.toml:3: turns of a study: expected a whole number")


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('calls = { mugg = "cup" }', "that others call mugg: did you mean mug?"),
        (
            'calls = { mug = "" }',
            'says "", which is not understood: write calls = { "mug" = "…" }',
        ),
        ('calls = { mug = "Cup" }', 'heard as "cup": write calls = { "mug" = "cup" }'),
        ('calls = { mug = "this" }', 'says "this", which is not understood'),
        ('calls = { "near" = "beside" }', 'says "beside", which is heard as "next to"'),
        ("calls = { mug = 3 }", 'a mug is called a text, as in { mug = "cup" }'),
        ('vocabulary = ["cupp"]', "Ann could say cupp: did you mean cup?"),
        ('vocabulary = ["cup", "left"]', "nothing of which Ann could say left"),
        (
            'vocabulary = ["shoe"]',
            "nothing is in these scenes: there is cup, mug, book",
        ),
    ],
)
def test_words_that_a_tutor_can_say_of_nothing_are_told(
    tmp_path: Path, line: str, told: str
) -> None:
    """He would be silent, or never be understood, and nobody would know why."""
    [fault] = wrong(tmp_path, (ANN, f"{ANN}\n{line}"))
    assert fault.startswith("study.toml:8: ")
    assert told in fault


@pytest.mark.parametrize(
    "lines",
    [
        'calls = { mug = "cup", shoe = "boot", red = "dark red" }',
        'vocabulary = ["cup", "shoe", "red", "to the left of"]',
        'calls = { mug = "mugg" }\nvocabulary = ["mugg", "cup"]',
        "calls = {}\nvocabulary = []",
    ],
)
def test_words_that_he_can_say_are_fine(tmp_path: Path, lines: str) -> None:
    assert not wrong(tmp_path, (ANN, f"{ANN}\n{lines}"))


def test_words_are_heard_in_the_language_of_each_theory(tmp_path: Path) -> None:
    swedish = ("[theories.two]", '[theories.two]\nlanguage = "sv"')
    assert not wrong(tmp_path, swedish)
    [fault] = wrong(tmp_path, swedish, (ANN, f'{ANN}\ncalls = {{ red = "the" }}'))
    assert "to one Ann says" in fault


def test_words_of_a_grammar_of_ones_own_are_heard_by_it(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    own = packaged("lexicon.en.toml").replace('next to" = ["beside", ', 'next to" = [')
    (tmp_path / "mine" / "lexicon.en.toml").write_text(own, encoding="utf-8")
    near = (ANN, f'{ANN}\ncalls = {{ near = "beside" }}')
    [fault] = wrong(
        tmp_path, ("[theories.two]", "[theories.two]\ngrammar = 'mine'"), near
    )
    assert fault.partition(": ")[2].startswith('to one Ann says "beside"')


@pytest.mark.parametrize("at", [0, -1])
def test_what_is_in_one_frame_only_has_a_name(
    data: Path, tmp_path: Path, at: int
) -> None:
    """Which frames are seen is drawn by the seed, and this one may be in another."""
    for scene in ("0001", "0002"):
        copytree(data / "ycbv_scenes" / scene, tmp_path / "data" / scene)
    first = read_sequence(tmp_path / "data/0002/scene.json")[0]
    [block] = [it for it, name in first.things.items() if name == "wood block"]
    files = sorted((tmp_path / "data/0002").glob("*_label.png"))
    for file in {*files} - {files[at]}:
        labels = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
        labels[labels == block] = 0
        cv2.imwrite(str(file), labels)
    captured = '"captures"\nfolder = "data"\neach = 1'
    assert not wrong(
        tmp_path,
        ('"drawn"\nkinds = ["cup", "mug", "book"]\neach = 2', captured),
        (ANN, f'{ANN}\ncalls = {{ "wood block" = "block" }}'),
    )


def test_categories_that_are_heard_otherwise_are_told(tmp_path: Path) -> None:
    """A folder called Mug teaches a word that the robot never says so."""
    image = np.random.default_rng(1).integers(0, 255, (40, 40, 3), np.uint8)
    for path in (tmp_path / "data" / it for it in ("Mug", "spoon")):
        path.mkdir(parents=True)
        for number in range(6):
            cv2.imwrite(str(path / f"{number}.png"), image)
    told = wrong(
        tmp_path,
        ('"drawn"\nkinds = ["cup", "mug", "book"]', '"pictures"\nfolder = "data"'),
    )
    assert [it.partition(": ")[2] for it in told] == [
        f'to one {tutor} says "Mug", which is heard as "mug": write calls = '
        '{ "Mug" = "mug" }'
        for tutor in ("Ann", "Bo")
    ]


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ('words = ["cupp"]', "cupp is none of the nouns that are taught: did you mean"),
        ('words = ["cup", "shoe"]', "shoe is none of the nouns that are taught: ther"),
        ('words = ["cup"]\nwhat = "adjectives"', 'taught: write what = "nouns"'),
        ("words = []", "expected one at least, found an empty list"),
        ('words = ["cup", "cup"]', '"cup" is there twice'),
    ],
)
def test_what_nobody_teaches_cannot_be_forgotten(
    tmp_path: Path, lines: str, told: str
) -> None:
    [fault] = wrong(tmp_path, ('do = "ask"\nof = "new"', f'do = "forget"\n{lines}'))
    assert fault.startswith("study.toml:18: ")
    assert told in fault


def test_what_is_forgotten_may_be_called_as_a_tutor_does(tmp_path: Path) -> None:
    forget = ('do = "ask"\nof = "new"', 'do = "forget"\nwords = ["beaker"]')
    assert wrong(tmp_path, forget)
    assert not wrong(tmp_path, forget, (ANN, f'{ANN}\ncalls = {{ mug = "beaker" }}'))
    own = (ANN, '[tutors.Ann]\nkind = "keyboard"')
    assert not wrong(tmp_path, forget, own)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        (
            (("seeds = 1", "seeds = 1\nturns = 12"),),
            "before takes 12 turns, and turns =",
        ),
        (
            (("each = 2", "each = 100"), ('do = "teach"', 'do = "teach"\nrounds = 2')),
            "before takes 1200 turns, and turns = 1000",
        ),
    ],
)
def test_a_phase_that_is_never_reached_is_told(
    tmp_path: Path, changes: tuple[tuple[str, str], ...], told: str
) -> None:
    """Dialogues would end before it, and nothing would be measured in it."""
    [fault] = wrong(tmp_path, *changes)
    assert "ask is never reached with table" in fault
    assert told in fault


def test_a_phase_that_may_be_reached_is_fine(tmp_path: Path) -> None:
    assert not wrong(tmp_path, ("seeds = 1", "seeds = 1\nturns = 13"))
    few = (ANN, f'{ANN}\nvocabulary = ["cup"]')
    assert not wrong(tmp_path, ("seeds = 1", "seeds = 1\nturns = 12"), few)


def test_what_tutors_scenes_and_phases_miss_is_told(tmp_path: Path) -> None:
    text = HEAD + "[theories.one]\n" + REST.format(scene="drawn")
    text += "[[phases]]\ndo = 'change_tutor'\nto = 'Bob'\n"
    text += "[tutors.both]\nkind = 'several'\nof = ['Ann', 'Bo']\n"
    told = check(parse(text, tmp_path / "study.toml"))
    assert any("Bob" in it for it in told)
    assert any("Bo" in it and "both" in it for it in told)
