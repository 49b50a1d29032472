"""Tables and figures say what the dialogues say, and lead to them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.measures.measures import ACCURACY
from kille.lab.measures.scored_dialogues import ScoredDialogue, score_dialogue
from kille.lab.reports import curves
from kille.lab.reports.conditions import compare_conditions
from kille.lab.reports.contrasts import contrast_results, correct_by_family
from kille.lab.reports.costs import cost_figures
from kille.lab.reports.drawing import drawing
from kille.lab.reports.findings import (
    Theories,
    detail_tables,
    group_by_theory,
    known_measures,
    overall_table,
)
from kille.lab.reports.links import places_of
from kille.lab.reports.repeated_tests import group_tests as asked_alike
from kille.lab.reports.repeated_tests import phases_of
from kille.lab.reports.summary import summary_result
from kille.lab.results import Estimate, Result, Table
from kille.lab.study import Phase, Run

SHARES: Mapping[str, Mapping[str, float]] = {
    "driven": {"silent": 0.5, "corrects": 0.5},
    "autonomous": {"silent": 0.25, "corrects": 1.0},
}
"""How much of what is asked each theory gets right, tutor by tutor."""


TESTS = [["teach 1", "teach 2"], ["test 1", "test 2"]]


def talk(theory: str, tutor: str, scene: str, seed: int) -> ScoredDialogue:
    """Two lessons each of a round, and four questions after each of the two rounds."""
    turns, answers = [], []
    for part in (1, 2):
        words = 3 + 2 * (tutor == "corrects")
        turns.append(
            Turn(2 * part, f"teach {part}", tutor, "instruct", "…", "OK.", words)
        )
        turns.append(Turn(2 * part + 1, f"test {part}", tutor, "ask_name", "?", "!", 2))
        for n in range(4):
            is_right = n < 4 * SHARES[theory][tutor]
            word = ("cup", "car")[(n + seed) % 2]
            other = "car" if word == "cup" else "cup"
            answers.append(
                Answer(
                    2 * part + 1,
                    f"test {part}",
                    "noun",
                    word,
                    word if is_right else other,
                    "assert" if is_right else "hedge",
                    0.75 if is_right else 0.25,
                    {word: 0.75, other: 0.25} if is_right else {word: 0.1, other: 0.25},
                    lessons=2 * part,
                )
            )
    run = Run(theory, tutor, scene, seed)
    return score_dialogue(run, Played(tuple(turns), tuple(answers), 4), 0.1)


def study(seeds: int = 6, scenes: tuple[str, ...] = ("table",)) -> Theories:
    talks = [
        talk(theory, tutor, scene, seed)
        for seed in range(1, seeds + 1)
        for scene in scenes
        for tutor in ("silent", "corrects")
        for theory in SHARES
    ]
    return group_by_theory(list(SHARES), talks)


def row(table: Table, *start: object) -> tuple[object, ...]:
    """What a row says after what it is called, estimates by their value."""
    (found,) = (it for it in table.rows if it[: len(start)] == start)
    cells = found[len(start) :]
    return tuple(it.value if isinstance(it, Estimate) else it for it in cells)


@pytest.fixture(scope="module")
def theories() -> Theories:
    return study()


def test_all_measures_are_there_for_all_theories(theories: Theories) -> None:
    measures = known_measures(theories)
    talks = [it for them in theories.values() for it in them]
    table = overall_table(theories, measures, places_of(list(theories), talks, "talks"))
    assert table.columns == ("", "driven", "autonomous")
    assert row(table, "dialogues") == (12, 12)
    assert row(table, "answers") == (96, 96)
    assert row(table, "accuracy") == (0.5, 0.625)
    assert row(table, "words") == (12, 12)
    assert not any(it[0] in ("κ tutor–judge", "reference") for it in table.rows)


def test_a_judge_who_always_agrees_with_the_tutor_is_no_ceiling() -> None:
    def judged(judge: str) -> list[str]:
        talk = asked("bold", ["assert"] * 3)
        first, *others = (it._replace(judge=judge) for it in talk.answers)
        answers = (first._replace(said="mug"), *others)
        measures = known_measures({"bold": [replace(talk, answers=answers)]})
        return [it.name for it in measures if "judge" in it.name]

    assert judged("") == judged("cup") == []
    assert judged("car") == ["κ robot–judge", "κ tutor–judge"]


def test_parts_are_told_and_lead_to_their_answers(theories: Theories) -> None:
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "talks")
    found = {it.title: it for it in detail_tables(theories, places)}
    assert row(found["By phase"], "test 2") == (0.5, 0.625, 48)
    assert row(found["By how it was put"], "assert") == (1.0, 1.0)
    assert row(found["By how it was put: answers"], "assert") == (48, 60)
    assert row(found["By word"], "noun", "cup")[-1] == 48
    place = found["By word"].links[0, 2]
    assert place == "talks/theory-1-answers.html#word-1"


def test_answers_are_counted_for_each_theory_where_they_are_not_as_many() -> None:
    """Two of eight are put as a hedge by one theory, and all eight by the other."""
    theories = {
        name: [asked(name, ["assert"] * (8 - hedges) + ["hedge"] * hedges)]
        for name, hedges in (("bold", 2), ("shy", 8))
    }
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "talks")
    found = {it.title: it for it in detail_tables(theories, places)}
    put = found["By how it was put: answers"]
    assert put.columns == ("way", "bold", "shy")
    assert row(put, "hedge") == (2, 8)
    assert row(put, "assert") == (6, 0)
    assert put.links[0, 1] == places.answers("bold", "way", "assert")
    assert row(found["By kind of word"], "noun")[-1] == 8
    assert "By kind of word: answers" not in found


def asked(theory: str, ways: Sequence[str], kind: str = "noun") -> ScoredDialogue:
    answers = [
        Answer(turn, "test", kind, "cup", "cup", way)
        for turn, way in enumerate(ways, start=1)
    ]
    return score_dialogue(
        Run(theory, "Ann", "table", 1), Played((), tuple(answers)), 0.1
    )


def test_things_are_not_counted_as_answers_with_words() -> None:
    talk = asked("bold", ["assert"] * 3)
    things = asked("bold", ["point"] * 2, "reference").answers
    theories = {"bold": [replace(talk, answers=talk.answers + things)]}
    places = places_of(["bold"], theories["bold"], "talks")
    table = overall_table(theories, known_measures(theories), places)
    assert row(table, "answers") == (3,)
    assert row(table, "things asked for") == (2,)
    assert table.links[2, 1] == places.answers("bold")
    assert table.links[3, 1] == places.theory("bold")


def test_of_words_that_were_never_asked_for_nothing_is_said() -> None:
    theories = {
        name: [asked(name, ["point"] * count, "reference")]
        for name, count in (("a", 1), ("b", 2))
    }
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    measures = known_measures(theories)
    (result,) = contrast_results(theories, [("a", "b")], measures, places)
    assert "accuracy" not in result.text
    assert "Question by question" not in {it.title for it in result.tables}


def test_tutors_are_compared_with_the_first_one(theories: Theories) -> None:
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "talks")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    found = {it.title: it for it in result.tables}
    assert "By scene" not in found
    assert row(found["By tutor"], "accuracy", "corrects") == (0.5, 1.0)
    against = found["Against the tutor silent"]
    names = "corrects − silent"
    assert row(against, "autonomous", "accuracy", names)[0] == 0.75
    assert row(against, "autonomous", "accuracy", names)[1] == "0.031"
    assert row(against, "driven", "words", names)[0] == 4
    assert not any(it[:2] == ("driven", "accuracy") for it in against.rows)


def test_several_scenes_are_told_with_the_tutors() -> None:
    theories = study(2, ("table", "floor"))
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    _, result = compare_conditions(theories, known_measures(theories), places)
    (both,) = result.tables
    assert both.title == "By tutor and scene"
    assert len(both.rows) == 8
    assert both.rows[0][:3] == ("accuracy", "silent", "table")
    assert both.rows[4][:3] == ("κ robot–tutor", "silent", "table")


def test_each_phase_is_told_with_each_tutor(theories: Theories) -> None:
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "talks")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    table = result.tables[0]
    assert table.title == "Accuracy, phase by phase"
    assert row(table, "test 2", "corrects") == (0.5, 1.0)
    assert len(table.rows) == 4
    assert table.links[1, 3] == places.dialogues("autonomous", "tutor", "corrects")


def test_two_people_who_never_quite_agree_are_drawn_as_the_ceiling() -> None:
    """The second judge says car where the first says cup, once in four times."""

    def judged(it: ScoredDialogue) -> ScoredDialogue:
        answers = (
            one._replace(judge="car" if n % 4 == 0 else one.right)
            for n, one in enumerate(it.answers)
        )
        return replace(it, answers=tuple(answers))

    theories = {name: list(map(judged, of)) for name, of in study().items()}
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    (figure,) = result.figures
    assert list(figure.data["series"]) == [*theories, "tutor and judge: the ceiling"]


def test_of_one_theory_it_is_said_what_tutors_change() -> None:
    theories = {"autonomous": study()["autonomous"]}
    places = places_of(list(theories), theories["autonomous"], "")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    assert result.text == (
        "The accuracy of autonomous with the tutor corrects differs from that with "
        "silent by 0.750 [0.750, 0.750] (p = 0.031)."
    )


def of_tutors(*rights: int) -> Theories:
    """A theory whose tutors A, B, … are told so many right words of eight.

    All but A and G are told one less with the first seed.
    """
    talks = []
    for seed in range(12):
        for tutor, right in zip("ABCDEFG", rights, strict=False):
            it = asked("bold", ["assert"] * 8)
            count = right - (seed == 0 and tutor not in "AG")
            answers = tuple(
                one._replace(said=one.right if n < count else "car")
                for n, one in enumerate(it.answers)
            )
            run = replace(it.run, tutor=tutor, seed=seed)
            talks.append(replace(it, run=run, answers=answers))
    return {"bold": talks}


def test_of_tutors_who_ask_nothing_nothing_is_said() -> None:
    theories = of_tutors(2, 4, 4)
    mute = [
        replace(it, answers=()) if it.run.tutor == "B" else it
        for it in theories["bold"]
    ]
    places = places_of(["bold"], mute, "")
    (result,) = compare_conditions(
        {"bold": mute}, known_measures({"bold": mute}), places
    )
    assert "–" not in result.text
    assert "tutor C differs" in result.text
    assert "tutor B" not in result.text


def test_how_p_is_found_is_said_where_no_theories_are_compared() -> None:
    theories = of_tutors(2, 4)
    places = places_of(["bold"], theories["bold"], "")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    (against,) = (it for it in result.tables if it.title.startswith("Against"))
    assert "above" not in against.note
    assert "p: permutation test" in against.note
    assert "Holm" in against.note


def test_of_many_tutors_those_are_told_that_differ() -> None:
    """Two of six are told as much as the first is but for one word, and one as much."""
    theories = of_tutors(2, 2, 8, 8, 2, 6, 2)
    places = places_of(["bold"], theories["bold"], "")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    first, *others = result.text.splitlines()
    assert first == (
        "Of 6 tutors 3 differ from A in accuracy (p < 0.05 after Holm's correction)."
    )
    assert [it.split(" with the tutor ")[1][0] for it in others] == ["C", "D", "F"]


def test_in_short_tutors_and_scenes_are_both_told() -> None:
    talks = [
        replace(it, run=replace(it.run, scene=scene), answers=it.answers[: 8 - less])
        for it in of_tutors(2, 4, 4)["bold"]
        for less, scene in enumerate(("table", "floor", "shelf"))
    ]
    places, theories = places_of(["bold"], talks, ""), {"bold": talks}
    found = list(compare_conditions(theories, known_measures(theories), places))
    short = summary_result(theories, known_measures(theories), found, places)
    told = [it.split(" differs ")[0] for it in short.text.splitlines()]
    assert told == [
        "The accuracy of bold with the tutor B",
        "The accuracy of bold with the tutor C",
        "Each p is after Holm's correction.",
        "The accuracy of bold with the scene floor",
        "The accuracy of bold with the scene shelf",
        "Each p is after Holm's correction.",
    ]


@pytest.mark.parametrize(
    ("tutors", "rows", "title"),
    [(2, 4, "Accuracy, phase by phase"), (30, 30, "Accuracy in Test B")],
)
def test_titles_say_which_phases_are_told(tutors: int, rows: int, title: str) -> None:
    """Of many rows those of the last phase; its name is as it was written."""
    it = asked("bold", ["assert"] * 2)
    first, last = it.answers
    answers = (first._replace(phase="Test A"), last._replace(phase="Test B", said=""))
    talks = [
        replace(it, run=replace(it.run, tutor=f"T{n}"), answers=answers)
        for n in range(tutors)
    ]
    theories, places = {"bold": talks}, places_of(["bold"], talks, "")
    (result,) = compare_conditions(theories, known_measures(theories), places)
    assert result.tables[0].title == title
    assert len(result.tables[0].rows) == rows
    figure, *_ = summary_result(theories, known_measures(theories), [], places).figures
    assert figure.title.startswith("Accuracy in Test B, by tutor")


def test_what_was_learned_is_drawn_against_what_it_cost(theories: Theories) -> None:
    by_phase, by_tutor = cost_figures(theories, TESTS)
    assert by_phase.title == "Accuracy against what it cost: test 1, test 2"
    driven = by_phase.data["series"]["driven"]
    assert driven["x"] == [4, 10]
    assert driven["mean"] == [0.5, 0.5]
    autonomous = by_tutor.data["series"]["autonomous"]
    assert autonomous["labels"] == ["silent", "corrects"]
    assert autonomous["x"] == [8, 12]
    assert autonomous["y"] == [0.25, 1.0]


def test_learning_is_drawn_by_lessons(theories: Theories) -> None:
    (figure,) = curves.learning_curves(theories, TESTS)
    assert figure.title == "Learning curve"
    assert figure.data["series"]["driven"]["x"] == [2, 4]
    assert figure.data["series"]["autonomous"]["mean"] == [0.625, 0.625]


@pytest.mark.parametrize(
    ("seeds", "told"),
    [
        (2, "Too few dialogues for confidence intervals."),
        (6, "95 % confidence intervals."),
    ],
)
def test_bands_are_spoken_of_where_some_are_drawn(seeds: int, told: str) -> None:
    few = study(seeds)
    figures = [
        *cost_figures(few, TESTS),
        *curves.learning_curves(few, TESTS),
        *curves.reliability_figures(few),
    ]
    assert len(figures) == 4
    assert all(figure.note.endswith(told) for figure in figures)


def test_other_tests_are_no_points_of_the_same_curve() -> None:
    """Before and after two lessons nouns are all named right, and adjectives never."""

    def answer(phase: str, kind: str, lessons: int) -> list[Answer]:
        said = "cup" if kind == "noun" else ""
        it = Answer(1, phase, kind, "cup", said, "assert", lessons=lessons)
        return [it] * 5

    given = [
        *answer("nouns 1", "noun", 0),
        *answer("colours 1", "adjective", 0),
        *answer("nouns 2", "noun", 2),
        *answer("colours 2", "adjective", 2),
    ]
    talk = score_dialogue(Run("a", "Ann", "table", 1), Played((), tuple(given)), 0.1)
    tests = [["nouns 1", "nouns 2"], ["lessons"], ["colours 1", "colours 2"]]
    nouns, colours = curves.learning_curves({"a": [talk]}, tests)
    assert nouns.title == "Learning curve: nouns 1, nouns 2"
    assert nouns.data["series"]["a"] | {"low": [], "high": []} == {
        "x": [0, 2],
        "mean": [1, 1],
        "low": [],
        "high": [],
    }
    assert colours.data["series"]["a"]["mean"] == [0, 0]


def test_phases_that_ask_alike_are_one_test_however_they_say_so() -> None:
    settings = ({"by": "both"}, {"by": "noun"}, {"of": "same", "rounds": 2})
    phases = [Phase(f"find {n}", "find", it) for n, it in enumerate(settings)]
    assert asked_alike(phases) == (("find 0", "find 2"), ("find 1",))


def test_of_a_test_that_is_not_repeated_no_cost_is_drawn(theories: Theories) -> None:
    (by_tutor,) = cost_figures(theories, [["test 1"], ["test 2"]])
    assert by_tutor.title == "Accuracy in test 2 against what it cost, by tutor"


def test_tutors_who_say_as_much_are_not_drawn_by_what_they_cost() -> None:
    talks = [talk("driven", "silent", "table", seed) for seed in range(1, 13)]
    talks = [
        replace(it, run=replace(it.run, tutor=f"tutor {it.run.seed % 2}"))
        for it in talks
    ]
    assert not list(cost_figures({"driven": talks}, []))


def test_where_one_tutor_cost_more_with_another_theory_he_is_not_named() -> None:
    theories = {
        name: [
            replace(
                talk("driven", tutor, "table", seed), run=Run(name, "Ann", "t", seed)
            )
            for seed in range(1, 7)
        ]
        for name, tutor in (("a", "silent"), ("b", "corrects"))
    }
    (figure,) = cost_figures(theories, [])
    assert figure.title == "Accuracy in test 2 against what it cost"
    assert figure.data["series"]["a"]["labels"] == []


def test_places_on_a_learning_curve_have_as_much_room_as_each_other() -> None:
    """Thirteen lessons are drawn by twos: each place is of two numbers of lessons."""
    given = [
        Answer(turn, "test", "noun", "cup", "cup", "assert", lessons=turn // 5)
        for turn in range(5 * 14)
    ]
    talk = score_dialogue(Run("a", "Ann", "table", 1), Played((), tuple(given)), 0.1)
    (figure,) = curves.learning_curves({"a": [talk]}, [["test"]])
    assert figure.data["series"]["a"]["x"] == [0, 2, 4, 6, 8, 10, 12, 14]


def test_degrees_are_drawn_against_shares(theories: Theories) -> None:
    (figure,) = curves.reliability_figures(theories)
    driven = figure.data["series"]["driven"]
    assert driven["x"] == [0.25, 0.75]
    assert driven["y"] == [0, 1]
    assert driven["counts"] == [48, 48]


def test_what_is_taken_for_what_is_drawn_for_each_theory(theories: Theories) -> None:
    first, second = curves.confusion_figures(theories)
    assert (first.title, second.title) == ("driven: nouns", "autonomous: nouns")
    assert np.trace(np.array(first.data["counts"])) == 48


def test_a_sentence_says_what_was_found(theories: Theories) -> None:
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    which = [("driven", "autonomous")]
    (result,) = contrast_results(theories, which, known_measures(theories), places)
    told = "The accuracy of autonomous differs from that of driven by 0.125 ["
    assert result.text.startswith(told)


def test_sentences_have_the_p_that_is_corrected_for_how_many_they_are() -> None:
    talks = [it for them in study().values() for it in them]
    theories = {
        "driven": [it for it in talks if it.run.theory == "driven"],
        "autonomous": [it for it in talks if it.run.theory == "autonomous"],
    }
    theories["third"] = [
        replace(it, run=replace(it.run, theory="third")) for it in theories["driven"]
    ]
    places = places_of(list(theories), talks, "")
    which = [("driven", "autonomous"), ("autonomous", "third"), ("driven", "third")]
    (result,) = contrast_results(theories, which, known_measures(theories), places)
    (table, *_) = (it for it in result.tables if it.title == "Paired differences")
    ps = [row[4] for row in table.rows if row[1] == "accuracy"]
    assert len(ps) == 2
    assert re.findall(r"p = ([\d.]+)\)", result.text) == ps
    assert "third and driven do equally well in every pair" in result.text
    assert result.text.endswith("Each p is after Holm's correction.")


def test_the_main_measure_is_corrected_by_itself() -> None:
    ps = [("accuracy", 0.03), ("words", 0.01), ("accuracy", 0.04), ("turns", 0.02)]
    assert correct_by_family(ps) == [0.06, 0.02, 0.06, 0.02]
    assert correct_by_family([("accuracy", 0.03), ("words", 0.5)])[0] == 0.03


def test_differences_are_told_measure_by_measure_the_main_one_first() -> None:
    theories = of_three()
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    which = [("driven", "third"), ("driven", "autonomous"), ("autonomous", "third")]
    (result,) = contrast_results(theories, which, known_measures(theories), places)
    told = [row[:2] for row in result.tables[0].rows]
    assert told[:3] == [
        ("autonomous − driven", "accuracy"),
        ("third − autonomous", "accuracy"),
        ("autonomous − driven", "κ robot–tutor"),
    ]
    (figure,) = result.figures
    assert figure.data["labels"] == ["autonomous − driven", "third − autonomous"]


def test_of_many_pairs_of_theories_those_are_told_that_differ() -> None:
    """Four are the same; the fifth knows all that is asked by the second tutor."""
    second = {
        name: [it for it in them if it.run.tutor == "corrects"]
        for name, them in study(12).items()
    }
    theories = {
        name: [replace(it, run=replace(it.run, theory=name)) for it in second[of]]
        for name, of in {**dict.fromkeys("abcd", "driven"), "e": "autonomous"}.items()
    }
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    which = list(combinations(theories, 2))
    (result,) = contrast_results(theories, which, known_measures(theories), places)
    first, *others = result.text.splitlines()
    assert first.startswith("Of 10 pairs of theories 4 differ in accuracy (p < 0.05 ")
    assert [it.partition(" differs from that of ")[2][:2] for it in others] == [
        f"{name} " for name in "abcd"
    ]
    short = summary_result(theories, known_measures(theories), [result], places)
    assert short.text == first


def of_three() -> Theories:
    base = study()
    copied = [replace(it, run=replace(it.run, theory="third")) for it in base["driven"]]
    return {**base, "third": copied}


def test_what_is_told_in_short(theories: Theories) -> None:
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "talks")
    found = [Result("How they differ", text="One line.\nAnd another.")]
    short = summary_result(theories, known_measures(theories), found, places)
    assert short.text == found[0].text
    (table,) = short.tables
    assert table.columns == (
        "theory",
        "dialogues",
        "accuracy",
        "accuracy in test 2",
        "κ robot–tutor",
        "words",
    )
    assert row(table, "autonomous")[:3] == (12, 0.625, 0.625)
    assert table.links[1, 2] == places.theory("autonomous")
    assert [it.title for it in short.figures] == [
        "Accuracy in test 2, by tutor",
        "Accuracy, phase by phase",
    ]
    assert short.figures[0].data["series"]["autonomous"]["values"] == [0.25, 1.0]


def test_the_last_phase_is_that_of_the_study() -> None:
    """In front of the first scene there is nothing for the second phase."""
    phases = {"bare": ("before", "after"), "rich": ("before", "between", "after")}
    talks = []
    for scene, names in phases.items():
        it = asked("bold", ["assert"] * len(names))
        answers = tuple(
            one._replace(phase=name)
            for one, name in zip(it.answers, names, strict=True)
        )
        talks.append(replace(it, run=replace(it.run, scene=scene), answers=answers))
    assert phases_of({"bold": talks}, ACCURACY) == ["before", "between", "after"]
    assert phases_of({"bold": talks[::-1]}, ACCURACY) == ["before", "between", "after"]


def test_in_short_things_are_told_where_no_words_were_asked_for() -> None:
    theories = {"bold": [asked("bold", ["point"] * 2, "reference")]}
    places = places_of(["bold"], theories["bold"], "")
    (table,) = summary_result(theories, known_measures(theories), [], places).tables
    assert row(table, "bold") == (1, 1.0)
    assert table.columns[2] == "reference"


def test_in_short_it_is_said_that_nothing_was_asked() -> None:
    theories = {"bold": [asked("bold", [])]}
    places = places_of(["bold"], theories["bold"], "")
    short = summary_result(theories, known_measures(theories), [], places)
    assert short.text.startswith("Nothing was asked to which the tutor knew an answer")
    assert not short.figures


def test_thirty_words_of_six_theories_are_figures_that_fit_on_a_page() -> None:
    words = [f"word {n:02}" for n in range(30)]
    answers = [
        Answer(n, "test", "noun", word, word, "assert") for n, word in enumerate(words)
    ]
    names = [f"a theory with a rather long name, number {n}" for n in range(6)]
    theories = {
        name: [score_dialogue(Run(name, "A", "t", 1), Played((), tuple(answers)), 0.1)]
        for name in names
    }
    figures = list(curves.word_figures(theories))
    assert [it for one in figures for it in one.data["labels"]] == words
    assert figures[0].title == "Word by word (1 of 5)"
    for figure in figures:
        assert drawing(figure).get_size_inches()[1] <= 9.5
        assert len(figure.data["series"]) == 6
        assert max(map(len, figure.data["series"])) <= 28


def test_the_main_measure_and_the_contrasts_can_be_planned() -> None:
    theories = of_three()
    talks = [it for them in theories.values() for it in them]
    places = places_of(list(theories), talks, "")
    measures = known_measures(theories)
    which = [("autonomous", "driven"), ("driven", "third")]
    (result,) = contrast_results(theories, which, measures, places, "κ robot–tutor")
    first, *_ = result.tables[0].rows
    assert first[:2] == ("driven − autonomous", "κ robot–tutor")
    assert first[3] == first[4], "nothing to correct for: the other two never differ"
    assert "The κ robot–tutor of driven differs from that of autonomous" in result.text
    assert "for the main measure (κ robot–tutor) over" in result.tables[0].note
    assert result.tables[0].links[0, 2] == places.against("driven", "autonomous")
    cells = summary_result(theories, measures, [], places, "turns").tables[0].columns
    assert "turns" in cells
