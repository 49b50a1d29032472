"""What is no mistake in a study, but is probably not meant."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.lab.study_files import read_and_check
from kille.lab.study_files.warnings import warnings_of

STUDY = """\
title = "Trying"
seeds = 1
[theories.one]
[theories.two]
without = ["hedge_name"]
[tutors.Ann]
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

PLACES = (
    ('kind = "drawn"\nkinds = ["cup", "mug", "book"]\neach = 2', 'kind = "around"'),
    ('do = "teach"', 'do = "teach"\n[[phases]]\ndo = "teach"\nwhat = "relations"'),
    ('do = "ask"\nof = "new"', 'do = "ask"\nwhat = "relations"'),
)
ANN = '[tutors.Ann]\nkind = "simulated"'
Change = tuple[str, str]

OWN = """\
class Mine:
    def learn_one(self, x, label): ...
    def predict_proba_one(self, x): return {}
"""


def found(folder: Path, *changes: Change) -> list[str]:
    """What is doubtful in a study that is fine but for these changes."""
    text = STUDY
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "study.toml").write_text(text, encoding="utf-8")
    (folder / "own.py").write_text(OWN)
    told = warnings_of(read_and_check(folder / "study.toml"))
    return [it.replace(f"{folder}/", "") for it in told]


def test_of_what_is_meant_there_is_no_doubt(tmp_path: Path) -> None:
    assert found(tmp_path) == []
    assert found(tmp_path, *PLACES) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "file",
    sorted(Path(__file__).parents[4].glob("examples/studies/**/*.toml")),
    ids=str,
)
def test_of_the_studies_that_are_shipped_there_is_none(
    file: Path, request: pytest.FixtureRequest
) -> None:
    if "shared/data" in file.read_text("utf-8"):
        request.getfixturevalue("data")
    assert warnings_of(read_and_check(file)) == ()


# --- theories -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        ("", "", True),
        ('about = "plain"', 'mode = "assisted"', True),
        ('learners.noun = "default"', 'wording = "paper"', True),
        ("strategy.bands.might = 0.05", "", True),
        ("", 'mode = "driven"', False),
        (
            'without = ["hedge_name", "guess_name"]',
            'without = ["guess_name", "hedge_name"]',
            True,
        ),
        ('learners.noun = "prototype"', "", False),
        ('mode = "person"', 'mode = "person"', False),
    ],
)
def test_theories_that_are_the_same_are_told(
    tmp_path: Path, one: str, other: str, alike: bool
) -> None:
    told = found(
        tmp_path,
        ("[theories.one]", f"[theories.one]\n{one}"),
        ('without = ["hedge_name"]', other),
    )
    same = "study.toml:5: two is the same theory as one: they will not differ"
    assert told == [same] * alike


def test_bands_that_take_the_place_of_others_are_told(tmp_path: Path) -> None:
    bold = ("[theories.one]", "[theories.one]\nstrategy.bands.sure = 0.1")
    assert found(tmp_path, bold) == [
        "study.toml:4: bands.sure = 0.1 is below bands.think = 0.2, in whose place it "
        "is then"
    ]


def test_learners_that_judge_nothing_are_told(tmp_path: Path) -> None:
    own = ("[theories.one]", "[theories.one]\nlearners.adjective = 'own.py:Mine'")
    told = "study.toml:4: no phase is about adjectives, so that own.py:Mine judges "
    assert found(tmp_path, own) == [f"{told}nothing"]
    asked = ('do = "ask"', 'do = "ask"\nwhat = "adjectives"')
    [known] = found(tmp_path, own, asked)
    assert known.endswith(
        'as the robot knows them beforehand: write colours = "taught" for the scenes'
    )
    taught = ('kind = "drawn"', 'kind = "drawn"\ncolours = "taught"')
    teach = ('do = "teach"', 'do = "teach"\nwhat = "adjectives"')
    assert found(tmp_path, own, asked, taught, teach) == []
    talked = ('do = "teach"', 'do = "talk"')
    relation = ("[theories.one]", "[theories.one]\nlearners.relation = 'kille'")
    assert found(tmp_path, relation, talked) == []


# --- tutors ---------------------------------------------------------------------------


def test_feedback_that_is_never_given_is_told(tmp_path: Path) -> None:
    mute = (ANN, f'{ANN}\nfeedback = "confirm"')
    [told] = found(tmp_path, mute)
    assert told == (
        "study.toml:8: feedback makes no difference: no phase is practise or talk"
    )
    assert found(tmp_path, mute, ('do = "teach"', 'do = "practise"')) == []


def test_what_he_would_call_things_that_are_not_there_is_told(tmp_path: Path) -> None:
    [told] = found(tmp_path, (ANN, f'{ANN}\ncalls = {{ shoe = "boot" }}'))
    assert told == "study.toml:8: there is no shoe in any scene that they could call so"


def test_the_left_of_what_has_no_front_is_told(tmp_path: Path) -> None:
    own = (ANN, f'{ANN}\nframe = "landmark"')
    assert found(tmp_path, *PLACES, own) == []
    blind = ('kind = "around"', 'kind = "around"\nfront = ""')
    [told] = found(tmp_path, *PLACES, own, blind)
    assert told.startswith("study.toml:8: the landmark of table has no front, so that")


def test_phases_in_which_he_has_no_word_are_told(tmp_path: Path) -> None:
    own = (ANN, f'{ANN}\nvocabulary = ["red", "cup"]')
    assert found(tmp_path, own) == []
    own = (ANN, f'{ANN}\nvocabulary = ["red"]')
    assert found(tmp_path, own) == [
        "study.toml:8: Ann has no word for the nouns of table, "
        f"and says nothing in {it}"
        for it in ("teach", "ask")
    ]


def test_lines_of_a_script_that_nobody_understands_are_told(tmp_path: Path) -> None:
    script = (ANN, '[tutors.Ann]\nkind = "scripted"\nfile = "a.dlg"')
    lines = ["--- a", "U> Thiss is a cup.", "U> This is a cup.", "S> OK.", "S~ and so"]
    (tmp_path / "a.dlg").write_text("\n".join(lines))
    assert found(tmp_path, script) == [
        "a.dlg:5: what S~ expects is not measured: write S> and all of it",
        "a.dlg:2: one does not understand “Thiss is a cup.”",
    ]
    (tmp_path / "a.dlg").write_text("U> Thiss is a cup.\nS> I do not understand.\n")
    assert found(tmp_path, script) == []


def test_words_that_a_script_asks_for_and_nobody_teaches_are_told(
    tmp_path: Path,
) -> None:
    script = (ANN, '[tutors.Ann]\nkind = "scripted"\nfile = "a.dlg"')
    lines = [
        *("U> This is a cup.", "S> OK, I learned a cup.", "U> This is a red book."),
        *("U> Is this a cpu?", "S> Yes.", "U> Is the book green?", "S> No."),
        *("U> Where is the teapot?", "U> Is the blue book near the cup?", "S> Yes."),
    ]
    (tmp_path / "a.dlg").write_text("\n".join(lines))
    assert found(tmp_path, script) == [
        "a.dlg:4: “cpu” is asked for, and no line teaches it: did you mean cup?",
        "a.dlg:8: “teapot” is asked for, and no line teaches it: teach it, or take the "
        "line out",
        "a.dlg:9: “near” is asked for, and no line teaches it: teach it, or take the "
        "line out",
    ]


def test_a_script_may_ask_for_what_the_robot_is_not_to_know(tmp_path: Path) -> None:
    script = (ANN, '[tutors.Ann]\nkind = "scripted"\nfile = "a.dlg"')
    said = "S> I have not learned what a teapot is. Please show me one."
    (tmp_path / "a.dlg").write_text(f"U> Where is the teapot?\n{said}\n")
    assert found(tmp_path, script) == []
    several = '\n[tutors.Bo]\nkind = "simulated"\n[[phases]]\ndo = "change_tutor"\n'
    (tmp_path / "a.dlg").write_text("U> Where is the teapot?\n")
    assert found(tmp_path, (script[0], script[1] + several)) == []


# --- scenes ---------------------------------------------------------------------------


def test_a_landmark_that_moves_when_nobody_asks_is_told(tmp_path: Path) -> None:
    moved = ('kind = "around"', 'kind = "around"\nshift = 0.2')
    [told] = found(tmp_path, *PLACES, moved)
    assert told.startswith("study.toml:10: the landmark moves for relations of = ")
    new = ('"ask"\nwhat = "relations"', '"ask"\nwhat = "relations"\nof = "new"')
    assert found(tmp_path, *PLACES, moved, new) == []


def test_fewer_things_in_view_than_there_should_be_are_told(tmp_path: Path) -> None:
    assert found(tmp_path, ("each = 2", "each = 2\nin_view = 3")) == []
    [told] = found(tmp_path, ("each = 2", "each = 2\nin_view = 4"))
    assert told == (
        "study.toml:12: 3 things only are in view in the phase ask: there are no more, "
        "by kinds and new = 1"
    )


def test_fewer_pictures_than_there_should_be_are_told(tmp_path: Path) -> None:
    image = np.random.default_rng(1).integers(0, 255, (40, 40, 3), np.uint8)
    for word, count in (("mug", 6), ("spoon", 4)):
        (tmp_path / "data" / word).mkdir(parents=True)
        for number in range(count):
            cv2.imwrite(str(tmp_path / "data" / word / f"{number}.png"), image)
    seen = (
        'kind = "drawn"\nkinds = ["cup", "mug", "book"]\neach = 2',
        'kind = "pictures"\nfolder = "data"\nnew = 3',
    )
    assert found(tmp_path, seen) == [
        "study.toml:11: of spoon there are 1 only, and not new = 3"
    ]
    assert found(tmp_path, seen, ('\nof = "new"', "")) == []


# --- phases ---------------------------------------------------------------------------


def test_a_study_in_which_nothing_is_asked_is_told(tmp_path: Path) -> None:
    told = "study.toml:12: nothing is asked, so that no answers are measured: write "
    told += 'do = "ask"'
    assert found(tmp_path, ('do = "ask"\nof = "new"', 'do = "rest"')) == [told]
    script = (ANN, '[tutors.Ann]\nkind = "scripted"\nfile = "a.dlg"')
    talk = ('do = "ask"\nof = "new"', 'do = "talk"')
    (tmp_path / "a.dlg").write_text("U> Hello.\n")
    for changes in ((script, talk), (script,)):  # a script asks nothing of its own
        assert [it.partition(":")[2][3:] for it in found(tmp_path, *changes)] == [
            told.partition(":")[2][3:]
        ]
    (tmp_path / "a.dlg").write_text("U> Hello.\nS> Hello.\n")
    assert found(tmp_path, script, talk) == []
    bo = (ANN, f'{script[1]}\n[tutors.Bo]\nkind = "simulated"')
    (tmp_path / "a.dlg").write_text("U> Hello.\n")
    assert found(tmp_path, bo) == []


def test_words_that_are_asked_for_and_never_taught_are_told(tmp_path: Path) -> None:
    places = ('do = "ask"', 'do = "ask"\nwhat = "relations"')
    assert found(tmp_path, places) == [
        "study.toml:14: ask asks for relations, which no phase teaches"
    ]
    colours = ('do = "ask"', 'do = "ask"\nwhat = "adjectives"')
    assert found(tmp_path, colours) == []
    taught = ('kind = "drawn"', 'kind = "drawn"\ncolours = "taught"')
    assert len(found(tmp_path, colours, taught)) == 1
    own = (ANN, '[tutors.Ann]\nkind = "keyboard"')
    assert found(tmp_path, places, own) == []


def test_words_by_which_things_are_to_be_found_are_taught(tmp_path: Path) -> None:
    seen = ("each = 2", "each = 2\nin_view = 3")
    finds = ('do = "ask"\nof = "new"', 'do = "find"')
    assert found(tmp_path, seen, finds) == []
    untaught = ('[[phases]]\ndo = "teach"\n', "")
    told = "study.toml:13: find asks for nouns, which no phase teaches"
    assert found(tmp_path, seen, finds, untaught) == [told]
    colour = ('do = "find"', 'do = "find"\nby = "colour"')
    assert found(tmp_path, seen, finds, untaught, colour) == []
    taught = ('kind = "drawn"', 'kind = "drawn"\ncolours = "taught"')
    assert len(found(tmp_path, seen, finds, colour, taught)) == 1


def test_places_of_which_nobody_can_say_beside_what_are_told(tmp_path: Path) -> None:
    told = "no nouns are taught before teach, and without those of the landmarks the "
    places = ('do = "teach"', 'do = "teach"\nwhat = "relations"')
    found_ = found(tmp_path, PLACES[0], places, PLACES[2])
    assert found_ == [f"study.toml:10: {told}robot says of nothing where it is"]
    own = (ANN, '[tutors.Ann]\nkind = "keyboard"')
    assert found(tmp_path, PLACES[0], places, PLACES[2], own) == []


def test_a_phase_that_aligns_with_nothing_is_told(tmp_path: Path) -> None:
    align = ('do = "ask"', 'do = "align"\n[[phases]]\ndo = "ask"')
    assert found(tmp_path, *PLACES[:2], align) == []
    blind = ('kind = "around"', 'kind = "around"\nfront = ""')
    assert found(tmp_path, *PLACES[:2], align, blind) == [
        "study.toml:16: nothing in table has a front, so that nothing is said in align"
    ]


def test_who_asks_for_both_sorts_knows_which_was_taught(tmp_path: Path) -> None:
    both = """do = "teach"
[[phases]]
do = "ask"
[[phases]]
name = "more"
do = "teach"
of = "new"
"""
    assert found(tmp_path, ('do = "teach"\n', both)) == []


def test_what_is_called_new_and_was_taught_is_told(tmp_path: Path) -> None:
    assert found(tmp_path, ('do = "teach"', 'do = "teach"\nof = "new"')) == [
        "study.toml:17: what is new in ask has been taught in teach"
    ]


def test_dialogues_that_end_before_all_is_done_are_told(tmp_path: Path) -> None:
    assert found(tmp_path, ("seeds = 1", "seeds = 1\nturns = 18")) == []
    assert found(tmp_path, ("seeds = 1", "seeds = 1\nturns = 17")) == [
        "study.toml:3: a dialogue takes 18 turns at least, and ends after 17: write "
        "turns = 18 or more"
    ]


def test_words_of_a_vocabulary_may_be_those_of_any_theory(tmp_path: Path) -> None:
    """Who has Swedish words says nothing to a theory in English, but to the other."""
    swedish = ("[theories.two]", '[theories.two]\nlanguage = "sv"')
    assert not found(tmp_path, swedish, (ANN, f'{ANN}\nvocabulary = ["kopp"]'))


def test_only_where_things_are_shown_alone_are_there_too_few(tmp_path: Path) -> None:
    """Of two things beside each other no others are shown, and in a rest none."""
    crowded = ("each = 2", "each = 2\nin_view = 7")
    rest = ('do = "ask"\nof = "new"', 'do = "rest"\n[[phases]]\ndo = "ask"')
    places = (
        'do = "teach"',
        'do = "teach"\n[[phases]]\ndo = "teach"\nwhat = "relations"',
    )
    told = found(tmp_path, crowded, rest, places)
    assert [it.partition(":")[0] for it in told] == ["study.toml"] * 2
    assert "in the phase teach:" in told[0]
    assert "in the phase ask:" in told[1]


def test_a_person_in_the_place_of_the_robot_may_know_the_words(tmp_path: Path) -> None:
    person = ("[theories.one]\n[theories.two]", '[theories.one]\nmode = "person"')
    alone = ('without = ["hedge_name"]\n', "")
    asked = ('[[phases]]\ndo = "teach"\n', "")
    assert not found(tmp_path, person, alone, asked)
    assert found(tmp_path, asked)
    places = ('do = "ask"\nof = "new"', 'do = "ask"\nwhat = "relations"')
    assert not found(tmp_path, person, alone, asked, places)
    assert found(tmp_path, asked, places)


def test_things_are_found_by_their_colours_too(tmp_path: Path) -> None:
    prototype = ("[theories.two]", '[theories.two]\nlearners.adjective = "prototype"')
    finding = ('do = "ask"\nof = "new"', 'do = "find"')
    assert not found(
        tmp_path, prototype, finding, ("each = 2", "each = 2\nin_view = 3")
    )
    assert found(tmp_path, prototype)
