"""What phrases refer to: composed, ranked word by word, set to things in view."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from math import isclose
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.describing import describe
from kille.dialogue.language import understand
from kille.dialogue.meanings import (
    adjective,
    noun,
    packaged_types,
    relation,
    theory,
    word_of,
)
from kille.dialogue.reference import (
    PhraseJudge,
    fitting_readings,
    intended_readings,
    meant_by,
    possible_readings,
    ranking,
    said_by,
    thing_at,
    things_in,
)
from kille.dialogue.reference.parts import take_apart
from kille.dialogue.reference.salience import choosing_predicates
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from ttr import Model, Record, RecordType, record, rectype, replace

Degrees = dict[tuple[str, ...], float]

NOUNS = [noun(form) for form in ("cup", "book")]
ADJECTIVES = [adjective(form) for form in ("red", "big", "old")]
RELATIONS = [relation(form) for form in ("near", "behind")]

TWO_CUPS: Degrees = {
    ("cup", "o1"): 0.9,
    ("cup", "o2"): 0.85,
    ("book", "o3"): 0.95,
    ("is_red", "o1"): 0.9,
    ("is_red", "o3"): 0.9,
    ("is_big", "o1"): 0.8,
    ("is_big", "o2"): 0.8,
    ("near", "o2", "o3"): 0.9,
    ("behind", "o3", "o1"): 0.9,
}


def scene(known: Degrees, things: int = 3, **changes: Any) -> tuple[Record, Model]:
    """The state and model before things of which words are true to these degrees."""
    signs = [*NOUNS, *ADJECTIVES, *RELATIONS]
    names = [f"o{n + 1}" for n in range(things)]
    model = blank_model().given("look1", theory()["Look"])
    for x in names:
        model = model.given(x, theory()["Ind"])
    for sign in signs:
        word = word_of(sign)
        arity = 2 if sign.kind == "relation" else 1
        by = partial(degree, known, word.name, arity)
        model = model.witnessed(word, by=by)
    view = record(
        look="look1", things=names, placed=names, focus=names[:1], pointed=names[:1]
    )
    state = replace(tutoring(signs).begin().state, view=view)
    return replace(state, changes), model


def degree(known: Degrees, word: str, arity: int, *args: str) -> float:
    return known.get((word, *args[:arity]), 0.0)


def said(text: str) -> RecordType:
    """What is said, in the reading with the words that are known."""
    known = {(it.kind, it.form) for it in (*NOUNS, *ADJECTIVES, *RELATIONS)}
    return next(
        it.content
        for it in understand(text)[0].readings
        if {(sign.kind, sign.form) for sign in it.signs} <= known
    )


def meant(text: str, known: Degrees = TWO_CUPS, **changes: Any) -> list[list[str]]:
    """The things that what is said may be about, by its readings."""
    s, model = scene(known, **changes)
    return [
        things_in(it.content)
        for it in intended_readings(s, possible_readings(s, model, said(text)))
    ]


# --- single phrases ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "things"),
    [
        ("What is this?", [["o1"]]),
        ("Where is the book?", [["o3"]]),
        ("Where is the red cup?", [["o1"]]),
        ("Where is the red one?", [["o3"], ["o1"]]),
        ("Where is the big red one?", [["o1"]]),
        ("Where is the cup?", [["o1"], ["o2"]]),
        ("Where is the cup near the book?", [["o2", "o3"]]),
        ("Where is the one near the book?", [["o2", "o3"]]),
        ("Where is the book behind the red cup?", [["o3", "o1"]]),
        ("Where is the cup near the book behind the red cup?", [["o2", "o3", "o1"]]),
        ("Where is the first cup?", [["o1"]]),
        ("Where is the second cup?", [["o2"]]),
        ("Where is the second one?", [["o2"]]),
        ("Where is the last one?", [["o3"]]),
        ("Where is the third cup?", []),
        ("Where is the left cup?", [["o1"]]),
        ("Where is the right big cup?", [["o2"]]),
        ("Where is the other cup?", [["o2"]]),
        ("Where is the old cup?", []),
    ],
)
def test_phrases(text: str, things: list[list[str]]) -> None:
    assert sorted(meant(text)) == sorted(things)


def test_counted_from_left_to_right() -> None:
    s, model = scene(TWO_CUPS)
    places = {"o1": 0.9, "o2": 0.2, "o3": 0.5}
    model = model.witnessed(theory()["across"], by=lambda x, look: places[x])
    for text, x in [
        ("What is the first cup?", "o2"),
        ("What is the second cup?", "o1"),
        ("What is the second one?", "o3"),
        ("What is the right one?", "o1"),
    ]:
        readings = intended_readings(s, possible_readings(s, model, said(text)))
        assert [it.things["target"] for it in readings] == [x]


def test_two_phrases_are_two_things() -> None:
    """A book stands near a book only if there are two."""
    both = meant("The cup is near the book.")
    assert sorted(both) == [["o1", "o3"], ["o2", "o3"]]
    assert meant("The book is near the book.") == []


def test_if_nothing_is_likely_red_the_one_that_might_be_is_meant() -> None:
    text, perhaps = "Where is the red cup?", {("is_red", "o1"): 0.1}
    one = {("cup", "o1"): 0.9} | perhaps
    assert meant(text, one) == [["o1"]]
    assert meant(text, one | {("cup", "o2"): 0.9, ("is_red", "o2"): 0.01}) == [["o1"]]
    assert meant(text, one | {("cup", "o2"): 0.9, ("is_red", "o2"): 0.1}) == []
    assert meant(text, {("cup", "o1"): 0.1, ("is_red", "o1"): 0.9}) == []


# --- what the talk is about ----------------------------------------------------------


def test_what_was_talked_about_last_is_meant() -> None:
    salient = {"shared.salient": ["o3", "o2"], "shared.topic": ["o3", "o2"]}
    assert meant("Where is the cup?", **salient) == [["o2"]]
    assert meant("Where is it?", **salient) == [["o3"]]
    assert meant("Where is the other cup?", **salient) == [["o1"]]
    assert meant("Where is the red cup?", **salient) == [["o1"]]


def test_what_was_talked_about_before_that_is_asked_about() -> None:
    for topic in ([], ["o3"], ["o1", "o2"]):
        changes = {"shared.salient": ["o3", "o2"], "shared.topic": topic}
        assert sorted(meant("Where is the cup?", **changes)) == [["o1"], ["o2"]]


def test_without_talk_it_is_what_is_shown() -> None:
    assert meant("What is it?") == [["o1"]]
    assert sorted(meant("What is the other one?")) == [["o2"], ["o3"]]


def test_nothing_unseen_is_meant() -> None:
    known = TWO_CUPS | {("cup", "o9"): 1.0}
    assert ["o9"] not in meant("Where is the cup?", known)
    assert meant("Where is it?", **{"shared.salient": ["o9"]}) == []


def test_a_resolved_phrase_is_specific() -> None:
    s, model = scene(TWO_CUPS)
    content = said("Where is the cup near the book?")
    (reading,) = intended_readings(s, possible_readings(s, model, content))
    target = reading.content["target"]
    assert isinstance(target, RecordType)
    assert thing_at(reading.content, "target") == "o2"
    assert thing_at(target, "landmark") == "o3"
    assert str(target["frame"]) == "Front@away"
    assert isclose(reading.p, 0.85 * 0.9 * 0.95)


def test_what_is_only_true_in_the_talk_is_no_part_of_it() -> None:
    s, model = scene(TWO_CUPS)
    (reading,) = intended_readings(
        s, possible_readings(s, model, said("What is this?"))
    )
    assert "d" not in reading.content["target"]  # type: ignore[operator]


# --- the perspective -----------------------------------------------------------------


def turned(x: str, y: str, look: str, front: str) -> float:
    """The first cup is near the book as the book faces, the second to the viewer."""
    near = {("o2", "away"), ("o1", "faces_left")}
    return 0.9 if y == "o3" and (x, front) in near else 0.0


@pytest.mark.parametrize(
    ("frame", "x", "front"),
    [("", "o2", "away"), ("viewer", "o2", "away"), ("landmark", "o1", "faces_left")],
)
def test_the_settled_perspective_decides(frame: str, x: str, front: str) -> None:
    facing = [record(x="o3", front="faces_left")]
    changes = {"shared.frame": frame, "shared.turned": facing}
    s, model = scene(TWO_CUPS, **changes)
    model = model.witnessed(word_of(relation("near")), by=turned)
    content = said("What is the cup near the book?")
    (reading,) = intended_readings(s, possible_readings(s, model, content))
    target = reading.content["target"]
    assert isinstance(target, RecordType)
    assert reading.things == {"target": x}
    assert str(target["frame"]) == f"Front@{front}"


# --- laws ----------------------------------------------------------------------------

degrees = st.sampled_from([0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0])


@st.composite
def scenes(draw: st.DrawFn) -> tuple[Record, Model]:
    """Up to four things, of which words are true to any degree."""
    things = draw(st.integers(1, 4))
    names = [f"o{n + 1}" for n in range(things)]
    known: Degrees = {}
    for sign in (*NOUNS, *ADJECTIVES):
        for x in names:
            known[word_of(sign).name, x] = draw(degrees)
    for sign in RELATIONS:
        for x in names:
            for y in names:
                known[word_of(sign).name, x, y] = draw(degrees)
    return scene(known, things)


@st.composite
def words(draw: st.DrawFn) -> list[Record]:
    """The words of a phrase, with adjectives, a noun, and perhaps a landmark."""
    some = st.lists(st.sampled_from(ADJECTIVES), max_size=2, unique_by=_form)
    phrase = [*draw(some), draw(st.sampled_from(NOUNS))]
    if draw(st.booleans()):
        phrase += [draw(st.sampled_from(RELATIONS)), draw(st.sampled_from(NOUNS))]
    return phrase


def _form(sign: Record) -> str:
    return str(sign.form)


@given(words())
def test_a_phrase_has_the_parts_of_its_words(phrase: list[Record]) -> None:
    whole, parts = (
        take_apart(meant_by(phrase), choosing_predicates(packaged_types())),
        said_by(phrase),
    )
    assert set(whole.claims) == set(parts.claims)
    assert whole.relations == parts.relations
    assert (whole.landmark is None) == (parts.landmark is None)


@given(scenes(), words())
def test_a_thing_fits_as_it_is_judged_to_be_of_the_type(
    drawn: tuple[Record, Model], phrase: list[Record]
) -> None:
    """Taking a type apart changes nothing: `perceive` says the same of the record."""
    s, model = drawn
    T = rectype(look=theory()["Look"], part=meant_by(phrase))
    for x, fit in PhraseJudge(s, model).fits(meant_by(phrase)).items():
        part = {"x": x, "look": "look1"}
        if len(fit.things) > 1:
            part |= {"frame": "away"}
            part["landmark"] = {"x": fit.things[1], "look": "look1"}  # type: ignore[assignment]
        judged = model.perceive(record(look="look1", part=part), T)
        assert isclose(judged.p.lo, fit.p, abs_tol=1e-9)


@given(scenes(), words())
def test_more_words_never_fit_better(
    drawn: tuple[Record, Model], phrase: list[Record]
) -> None:
    judging = PhraseJudge(*drawn)
    fits = [judging.fits_part(said_by(phrase[: n + 1])) for n in range(len(phrase))]
    for before, after in pairwise(fits):
        assert all(fit.p <= before[x].p + 1e-9 for x, fit in after.items())


@given(scenes(), words())
def test_shares_sum_to_one(drawn: tuple[Record, Model], phrase: list[Record]) -> None:
    shares = ranking(*drawn, phrase)
    assert len(shares) == len(phrase)
    for after in shares:
        assert not after or isclose(sum(after.values()), 1.0)


@given(scenes(), st.permutations(ADJECTIVES), st.sampled_from(NOUNS))
def test_the_order_of_adjectives_does_not_matter(
    drawn: tuple[Record, Model], adjectives: Sequence[Record], head: Record
) -> None:
    shuffled = ranking(*drawn, [*adjectives, head])[-1]
    plain = ranking(*drawn, [*ADJECTIVES, head])[-1]
    assert shuffled.keys() == plain.keys()
    assert all(isclose(shuffled[x], plain[x]) for x in plain)


@given(scenes(), words())
def test_a_word_that_is_as_true_of_everything_changes_no_share(
    drawn: tuple[Record, Model], phrase: list[Record]
) -> None:
    s, model = drawn
    shiny = adjective("shiny")
    model = model.witnessed(word_of(shiny), by=lambda x, look: 0.5)
    shares, more = ranking(s, model, phrase), ranking(s, model, [shiny, *phrase])
    assert shares[-1].keys() == more[-1].keys()
    assert all(isclose(shares[-1][x], more[-1][x]) for x in shares[-1])


# --- descriptions --------------------------------------------------------------------


def described(x: str, known: Degrees = TWO_CUPS, **of: Any) -> str | None:
    found = describe(*scene(known), x, **of)
    return None if found is None else " ".join(sign.form for sign in found.signs)


def test_the_shortest_description() -> None:
    assert described("o1") == "red cup"
    assert described("o2") == "cup near book"
    assert described("o3") == "book"


def test_a_description_has_as_many_words_as_it_takes() -> None:
    cups = {("cup", x): 0.9 for x in ("o1", "o2", "o3")}
    both = cups | {("is_red", "o1"): 0.9, ("is_big", "o1"): 0.8}
    assert described("o1", both) == "red cup"
    both |= {("is_red", "o2"): 0.9, ("is_big", "o3"): 0.8}
    assert described("o1", both) == "red big cup"
    where = {
        **{("cup", x): 0.9 for x in ("o1", "o2")},
        **{("book", "o3"): 0.9, ("near", "o1", "o3"): 0.9},
        **{("is_red", x): 0.9 for x in ("o1", "o2", "o3")},
    }
    assert described("o1", where) == "cup near book"
    four = where | {("cup", "o4"): 0.9, ("near", "o4", "o3"): 0.9}
    found = describe(*scene(four, things=4), "o1")
    assert found is not None
    assert " ".join(sign.form for sign in found.signs) == "red cup near book"


def test_a_landmark_is_described_where_its_noun_is_not_enough() -> None:
    known = {
        **{("cup", x): 0.9 for x in ("o1", "o2")},
        **{("book", x): 0.9 for x in ("o3", "o4")},
        **{("near", "o1", "o3"): 0.9, ("near", "o2", "o4"): 0.9},
        **{("is_red", "o3"): 0.9, ("is_big", "o4"): 0.9},
    }
    for x, words in {"o1": "cup near red book", "o2": "cup near big book"}.items():
        found = describe(*scene(known, things=4), x)
        assert found is not None
        assert " ".join(sign.form for sign in found.signs) == words


def test_told_only_from_some() -> None:
    assert described("o2", among=["o2", "o3"]) == "cup"


def test_what_has_no_noun_is_described_by_a_quality() -> None:
    assert described("o1", {("is_red", "o1"): 0.9, ("cup", "o2"): 0.9}) == "red"


def test_what_is_like_another_thing_in_all_has_no_description() -> None:
    assert described("o1", {("cup", "o1"): 0.9, ("cup", "o2"): 0.9}) is None


@given(scenes())
def test_what_describes_a_thing_resolves_to_it(drawn: tuple[Record, Model]) -> None:
    """The resolver finds by it that thing and no other, and it fits best of all."""
    s, model = drawn
    for x in s.view.things:
        found = describe(s, model, x)
        if found is None:
            continue
        content = rectype(look=theory()["Look"], target=found.phrase)
        readings = possible_readings(s, model, content)
        [best] = fitting_readings(s, readings)
        assert best.things == {"target": x}
        assert all(it.p < best.p for it in readings if it is not best)
