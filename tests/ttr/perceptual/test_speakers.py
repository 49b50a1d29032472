"""Speakers correct one another, and what they mean is compared."""

import pytest

from ttr import Ind, Pred, TTRError, record, rectype, this
from ttr.errors import UnsupportedError
from ttr.semantics.perceptual import (
    Agreement,
    ByLearner,
    Perceptron,
    RealVector,
    Speaker,
    agreement,
    blank,
    convergence,
    difference,
    exchange,
    history,
    interpretation,
    learner_params,
    meaning,
    says,
)


def word(name, method, params):
    T = rectype(x=Ind, pos=RealVector, c=Pred(name, Ind)(this.x))
    return meaning(interpretation(T, "c"), method, params, of="pos")


def at(*pos):
    return record(x="o1", pos=pos)


class Counting:
    """A learner with the shares of the labels it was taught, whatever it sees."""

    def __init__(self):
        self.seen = []

    def learn_one(self, x, y):
        self.seen.append(y)

    def predict_proba_one(self, x):
        return {y: self.seen.count(y) / len(self.seen) for y in self.seen}


GRID = [at(x / 4, y / 4) for x in range(-4, 5) for y in range(-4, 5)]


@pytest.fixture
def teacher():
    return Speaker("a", {"right": word("right", Perceptron(), record(w=[1, 0], t=0))})


@pytest.fixture
def pupil():
    return Speaker("b", {"right": word("right", Perceptron(0.5), blank(2))})


def test_a_speaker_has_meanings_of_words(teacher):
    assert str(teacher) == "a, who knows right"
    assert teacher["right"].classify(at(1, 0)) is Pred("right", Ind)("o1")
    with pytest.raises(TTRError, match="a has no meaning of 'rigth'") as wrong:
        _ = teacher["rigth"]
    assert wrong.value.hint == "did you mean right?"
    with pytest.raises(TypeError):
        teacher.meanings["left"] = teacher["right"]


@pytest.mark.parametrize("meanings", [["right"], {"right": "right"}])
def test_what_is_no_speaker(meanings):
    with pytest.raises(TTRError, match=r"a mapping from words|a perceptual meaning is"):
        Speaker("a", meanings)


def test_the_word_that_fits_best_comes_first():
    params = {"wide": record(w=[1, 0], t=-2), "right": record(w=[1, 0], t=0.5)}
    who = Speaker("a", {n: word(n, Perceptron(), p) for n, p in params.items()})
    assert list(who.degrees(at(0, 0))) == ["wide", "right"]
    assert list(who.degrees(at(1, 0))) == ["right", "wide"]
    assert who.degrees(record(x="o1")) == {}


def test_where_they_agree_nothing_changes(teacher, pupil):
    assert exchange(teacher, pupil, "right", at(-1, 0)) is pupil
    after = exchange(teacher, pupil, "right", at(1, 0))
    assert after["right"] != pupil["right"]
    assert says(after["right"], at(1, 0))
    assert exchange(teacher, after, "right", at(1, 0)) is after
    assert not says(pupil["right"], at(1, 0))


def test_the_pupil_comes_to_mean_what_the_teacher_means(teacher, pupil):
    pupils = history(teacher, pupil, "right", GRID * 3)
    assert len(pupils) == len(GRID) * 3 + 1
    assert pupils[0] is pupil
    series = convergence(teacher, pupils, "right", GRID).series
    assert series[0].share == pytest.approx(45 / 81)
    assert series[-1].share > 0.95
    assert series[-1].apart == pytest.approx(1 - series[-1].share)


def test_no_this_is_a_mug():
    params = record(w=[1.0, 0.0], t=0.0)
    who = Speaker(
        "a",
        {
            "cup": word("cup", Perceptron(), params),
            "mug": word("mug", Perceptron(), blank(2)),
        },
    )
    after = who.corrected(at(0.5, 0.5), said="cup", right="mug")
    assert after["cup"].params == record(w=[0.5, -0.5], t=1.0)
    assert after["mug"].params == record(w=[0.5, 0.5], t=-1.0)
    assert who["cup"].params is params
    with pytest.raises(TTRError, match="'cup' cannot be what is corrected and what"):
        who.corrected(at(0, 0), said="cup", right="cup")


def test_words_with_one_learner_learn_together():
    params = learner_params(Counting())
    words = {n: word(n, ByLearner(n), params) for n in ("cup", "mug", "spoon")}
    who = Speaker("a", words).confirmed("cup", at(0))
    assert who["mug"].params is who["cup"].params
    assert str(who["mug"].params.learner) == "Counting + 1 lesson"
    after = who.corrected(at(0), said="cup", right="mug")
    assert [after[n].degree(at(0)) for n in words] == [(0.5, 0.5)] * 2 + [(0.0, 0.0)]
    assert str(after["spoon"].params.learner) == "Counting + 2 lessons"
    assert who["cup"].degree(at(0)) == (1.0, 1.0)


def test_a_correction_that_one_of_them_cannot_take_changes_neither():
    words = {n: word(n, ByLearner(n), learner_params(Counting())) for n in ("a", "b")}
    who = Speaker("a", words)
    with pytest.raises(
        UnsupportedError, match="that it is not a teaches this learner noth"
    ):
        who.corrected(at(0), said="a", right="b")
    assert who.meanings == words


# --- comparing -----------------------------------------------------------------------


def test_agreement_in_numbers():
    one = word("right", Perceptron(), record(w=[1, 0], t=0))
    other = word("right", Perceptron(), record(w=[0, 1], t=0))
    found = agreement(one, other, [at(1, 1), at(1, -1), at(-1, 1), at(-1, -1)])
    assert found == Agreement(both=1, first=1, second=1, neither=1, apart=0.5)
    assert (found.count, found.share, found.kappa) == (4, 0.5, 0.0)
    assert str(found) == "50% alike, κ 0.00, 0.50 apart"


def test_kappa_of_a_textbook():
    # Two readers of 50 applications: yes of both 20, of the first 5, of the second 10.
    assert Agreement(20, 5, 10, 15, 0.3).kappa == pytest.approx(0.4)


def test_kappa_is_undefined_where_chance_alone_makes_them_agree():
    found = Agreement(3, 0, 0, 0, 0.0)
    assert found.kappa is None
    assert str(found) == "100% alike, κ undefined, 0.00 apart"


def test_two_meanings_are_compared_over_something(teacher):
    with pytest.raises(TTRError, match="over one situation or more, not none"):
        agreement(teacher["right"], teacher["right"], [])


def test_records_of_meanings_are_compared_as_meanings(teacher, pupil):
    one, other = teacher["right"], pupil["right"]
    assert difference(one.record, other) == difference(one, other.record)
    assert agreement(one.record, other.record, GRID) == agreement(one, other, GRID)
    with pytest.raises(TTRError, match="a perceptual meaning is a record"):
        agreement(teacher, pupil, GRID)


def test_convergence_prints_line_by_line(teacher, pupil):
    pupils = history(teacher, pupil, "right", [at(1, 0)])
    shown = str(convergence(teacher, pupils, "right", [at(1, 0), at(-1, 0)]))
    assert shown.splitlines() == [
        "after 0: 50% alike, κ 0.00, 0.50 apart",
        "after 1: 100% alike, κ 1.00, 0.00 apart",
    ]


def test_a_difference_is_told_path_by_path(teacher, pupil):
    assert difference(teacher["right"], teacher["right"]) == ()
    after = pupil.confirmed("right", at(1, 0))["right"]
    assert difference(pupil["right"], after) == (
        "params.t: 0.0 → -0.5",
        "params.w: [0.0, 0.0] → [0.5, 0.0]",
    )
