"""Perceptual meanings: records, judged of situations and in models, and corrected."""

import math
import re
from base64 import b64decode
from xml.etree import ElementTree

import pytest

from rich_values import check_html
from ttr import (
    Basic,
    Ind,
    Model,
    Pred,
    TTRError,
    amerge,
    box,
    fun,
    html,
    merge,
    outer,
    record,
    rectype,
    replace,
    this,
)
from ttr.building import fix
from ttr.degree_pictures import CELLS
from ttr.errors import IllFormedError, UndecidedError, UnsupportedError
from ttr.probability import UNKNOWN
from ttr.semantics.perceptual import (
    Classifier,
    GradedPerceptron,
    Meaning,
    Perceptron,
    Projective,
    RealVector,
    blank,
    combined_type,
    interpretation,
    meaning,
    perceive,
)
from ttr.types import Meet

right = Pred("right", Ind)
BG = rectype(foo=Ind, spkr=Ind, pos=RealVector)
INTERP = fun(r=BG)(rectype(c=right(outer.r.foo)))
LARSSON = record(w=[0.8, 0.01], t=0.09)


@pytest.fixture
def to_the_right():
    return meaning(INTERP, Perceptron(), LARSSON, of="pos")


@pytest.fixture
def M():
    M = Model()
    for name in ("o1", "o2", "a"):
        M = M.given(name, Ind)
    return M


def at(*pos, foo="o1"):
    return record(foo=foo, spkr="a", pos=pos)


# --- as a record ---------------------------------------------------------------------


def test_a_meaning_is_a_record_and_prints_as_one(to_the_right):
    assert to_the_right.record["params.w"] == (0.8, 0.01)
    assert to_the_right.record.bg is BG
    assert to_the_right.record.interp is INTERP
    assert str(to_the_right) == (
        "{bg = [foo : Ind, pos : RealVector, spkr : Ind], "
        "clf = <Classifier of pos by a perceptron>, "
        "interp = \\r:[foo : Ind, pos : RealVector, spkr : Ind]. [c : right(r.foo)], "
        "params = {t = 0.09, w = [0.8, 0.01]}}"
    )
    assert "⎡t = 0.09       ⎤" in box(to_the_right.record)
    assert to_the_right._repr_latex_() == to_the_right.record._repr_latex_()


def drawn_of(shown):
    """The picture in what a notebook shows."""
    (drawn,) = re.findall(r'svg\+xml;base64,([^"]*)"', html(shown))
    return ElementTree.fromstring(b64decode(drawn))


def test_a_meaning_of_points_shows_where_in_the_plane_it_holds(to_the_right):
    check_html(to_the_right._repr_html_())
    picture = drawn_of(to_the_right)
    squares = picture.findall(".//*[@fill-opacity]")
    assert {it.get("fill-opacity") for it in squares} == {"1.00"}
    cell = float(squares[0].get("height"))
    ends = [float(it.get("x")) + float(it.get("width")) for it in squares]
    assert len(ends) == CELLS
    assert len({*ends}) == 1, "the right edge"
    covered = sum(float(it.get("width")) for it in squares) / (CELLS * CELLS * cell)
    assert covered == pytest.approx((1 - 0.09 / 0.8) / 2, abs=0.03)


SURE = fun(r=rectype(x=Ind, height=RealVector))(rectype(c=Pred("tall", Ind)(outer.r.x)))


class Above:
    """A number is tall if it is above a threshold; between two, who knows."""

    def confirmed(self, params, x):
        return params

    rejected = confirmed

    def degree(self, params, x):
        return (0, 1) if params.t <= x < params.u else float(x >= params.u)


@pytest.mark.parametrize(
    ("method", "params", "border"),
    [
        (Perceptron(), record(w=[2.0], t=3.7), "1.85"),
        (GradedPerceptron(), record(w=[20.0], t=37.0), "1.85"),
        (GradedPerceptron(), record(w=[-0.1], t=2000.0), "-20000"),
    ],
)
def test_a_meaning_of_a_number_is_a_curve_with_its_border(method, params, border):
    tall = meaning(SURE, method, params, of="height")
    check_html(tall._repr_html_())
    picture = drawn_of(tall)
    labels = [it.text for it in picture.iter() if it.tag.endswith("text")]
    assert labels[-5] == border
    assert f"crosses a half at {border}" in html(tall)
    ends = float(labels[-4]), float(labels[-3])
    assert ends[0] < float(border) < ends[1]


def test_an_interval_of_degrees_is_a_band():
    tall = meaning(SURE, Above(), record(t=1.7, u=1.8), of="height")
    band = drawn_of(tall).find(".//*[@points][@fill-opacity]").get("points").split()
    upper, lower = band[: len(band) // 2], band[len(band) // 2 :][::-1]
    apart = [one != other for one, other in zip(upper, lower, strict=True)]
    assert any(apart)
    assert not all(apart)


def test_a_meaning_that_holds_alike_everywhere_has_no_picture():
    for w in ([0.0], [0.0] * 3):
        flat = meaning(SURE, GradedPerceptron(), record(w=w, t=0.1), of="height")
        assert "svg" not in html(flat)


def test_meanings_are_compared_as_records(to_the_right):
    twin = Meaning(to_the_right.record)
    assert twin == to_the_right
    assert hash(twin) == hash(to_the_right)
    assert twin != to_the_right.with_params({"w": [0.8, 0.01], "t": 0.1})


def test_an_asymmetric_merge_can_say_that_it_was_learned(to_the_right):
    learned = to_the_right.rejected(at(0.9, 0.1))
    assert learned.params != to_the_right.params
    change = record(params=learned.params)
    assert replace(to_the_right.record, params=learned.params) == learned.record
    fields = {label: Basic("Any") @ value for label, value in _items(to_the_right)}
    told = amerge(rectype(fields), rectype(params=Basic("Any") @ change.params))
    assert told == rectype(
        {label: Basic("Any") @ value for label, value in _items(learned)}
    )


def _items(meant):
    return [(label, meant.record[label]) for label in meant.record]


@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        ({"params": 1}, "the params of a meaning is a record, found 1"),
        ({"bg": Ind}, "the bg of a meaning is a record type, found Ind"),
        ({"clf": "clf"}, "the clf of a meaning is a Classifier, found clf"),
        ({"interp": Ind}, "the interp of a meaning is a function, found Ind"),
        ({"bg": rectype(foo=Ind)}, "takes situations of its bg [foo : Ind], found"),
        (
            {"clf": Classifier(Perceptron(), ("place",))},
            "the percept is to be found at place, which the bg [foo : Ind, ",
        ),
        (
            {"clf": Classifier(Perceptron(), ("pos.x",))},
            "the percept is to be found at pos.x, which the bg [foo : Ind, ",
        ),
    ],
)
def test_what_is_no_meaning(to_the_right, change, wrong):
    with pytest.raises(TTRError, match=r"bg|params|clf|interp") as refused:
        Meaning(replace(to_the_right.record, change))
    assert wrong in refused.value.message


@pytest.mark.parametrize("found", [record(), record(params=LARSSON), "right"])
def test_what_is_no_record_of_a_meaning(found):
    with pytest.raises(TTRError, match=r"a record {params, bg, clf, interp}, found"):
        Meaning(found)


@pytest.mark.parametrize(
    "body",
    [
        right(this.r.foo),
        rectype(c=Ind),
        rectype(c=right(outer.r.foo), d=right(outer.r.spkr)),
    ],
)
def test_an_interpretation_has_one_ptype(body):
    with pytest.raises(IllFormedError, match="a record type with one ptype, as in"):
        meaning(fun(r=BG)(body), Perceptron(), LARSSON, of="pos")


def test_an_interpretation_of_a_type_is_the_inverse_of_fix(to_the_right):
    assert str(to_the_right.type) == (
        "[foo : Ind, pos : RealVector, spkr : Ind, c : right(foo)]"
    )
    assert interpretation(to_the_right.type, "c") is INTERP
    for label in ("foo", "nonesuch"):
        with pytest.raises(IllFormedError, match=f"with a ptype at {label}"):
            interpretation(to_the_right.type, label)
    with pytest.raises(IllFormedError, match="with a ptype at c, found"):
        interpretation(Ind, "c")


# --- judging -------------------------------------------------------------------------


def test_a_situation_gets_a_type(to_the_right):
    assert to_the_right.score(at(0.9, 0.1)) == pytest.approx(0.721)
    assert to_the_right.classify(at(0.9, 0.1)) is right("o1")
    assert to_the_right.classify(at(-0.9, 0.1, foo="o2")) is ~right("o2")
    assert to_the_right.content(at(0.9, 0.1)) is rectype(c=right("o1"))


def test_at_the_threshold_it_is_not_so():
    edge = meaning(INTERP, Perceptron(), record(w=[1, 0], t=0.5), of="pos")
    assert edge.classify(at(0.5, 0)) is ~right("o1")
    assert edge.classify(at(math.nextafter(0.5, 1), 0)) is right("o1")


def test_in_a_model_it_is_perceived_judged_and_explained(to_the_right, M):
    j = to_the_right.judge(M, at(0.9, 0.1))
    assert j.holds
    assert j.type is to_the_right.type
    assert str(j.why).splitlines()[-1].strip() == "✓ c: e1 : right(o1)   (given)"
    assert not to_the_right.judge(M, at(-0.9, 0.1)).holds
    assert M.judge("o1", Ind).holds
    stranger = to_the_right.judge(M, at(0.9, 0.1, foo="o9"))
    assert stranger.why.path() == "foo"


def test_in_a_model_the_percept_is_that_of_the_situation_shown(to_the_right, M):
    M = to_the_right.in_model(M, at(0.9, 0.1), at(-0.9, 0.1, foo="o2"))
    T = rectype(x=Ind, c=right(this.x))
    degrees = [M.perceive(record(x=x), T).p for x in ("o1", "o2", "a")]
    assert degrees == [(1.0, 1.0), (0.0, 0.0), UNKNOWN]
    moved = to_the_right.in_model(M, at(0.9, 0.1), at(-0.9, 0.1))
    assert moved.perceive(record(x="o1"), T).p == (0.0, 0.0)


def test_a_percept_may_be_in_what_more_is_said_of():
    T = rectype(x=rectype(a=Ind) & rectype(pos=RealVector), c=right(this.x.a))
    meant = meaning(interpretation(T, "c"), Perceptron(), LARSSON, of="x.pos")
    seen = record(x=record(a="o1", pos=(0.9, 0.1)))
    assert meant.classify(seen) is right("o1")


def test_a_percept_among_the_arguments_needs_no_situation():
    lit = Pred("lit", Ind, RealVector)
    T = rectype(x=Ind, seen=RealVector, c=lit(this.x, this.seen))
    meant = meaning(
        interpretation(T, "c"),
        GradedPerceptron(steepness=1.0),
        record(w=[1.0], t=0.0),
        of="seen",
    )
    M = meant.in_model(Model().given("o1", Ind))
    j = M.perceive(record(x="o1", seen=[2.0]), T)
    assert j.p.lo == pytest.approx(1 / (1 + math.exp(-2.0)))
    assert meant.degree(record(x="o1", seen=[2.0])) == j.p
    assert M.judge([math.nan], RealVector).holds is False


def test_red_cups_are_what_both_classifiers_judge(M):
    def word(name, percept, t):
        T = rectype({"x": Ind, percept: RealVector, "c": Pred(name, Ind)(this.x)})
        method = GradedPerceptron(steepness=1.0)
        interp = interpretation(T, "c")
        return meaning(interp, method, record(w=[1.0], t=t), of=percept)

    red, cup = word("red", "colour", 0.0), word("cup", "shape", 1.0)
    r = record(x="o1", colour=[0.5], shape=[0.5])
    RedCup = combined_type(red, cup)
    assert RedCup is merge(red.type, cup.type)
    assert isinstance(RedCup["c"], Meet)
    j = perceive(M, r, red, cup)
    assert j.p.lo == pytest.approx(red.degree(r).lo * cup.degree(r).lo)
    assert j.type is RedCup
    assert RedCup <= red.type
    assert RedCup <= cup.type
    with pytest.raises(TTRError, match="one meaning or more, found none"):
        combined_type()


def test_a_handle_is_sensed_and_what_is_not_there_is_unknown(M):
    pictures = {"img1": (0.9, 0.1)}
    T = rectype(x=Ind, img=Basic("Image"), c=right(this.x))
    interp = interpretation(T, "c")
    meant = meaning(interp, Perceptron(), LARSSON, of="img", through=pictures.get)
    seen, gone = record(x="o1", img="img1"), record(x="o1", img="img2")
    assert meant.degree(seen) == (1.0, 1.0)
    assert meant.degree(gone) == UNKNOWN
    assert meant.in_model(M, gone).perceive(record(x="o1"), rectype(c=right("o1"))).p
    with pytest.raises(UndecidedError, match=r"right: .* may be so or not"):
        meant.classify(gone)
    with pytest.raises(UndecidedError, match="right: nothing can be seen"):
        meant.score(gone)
    for learn in (meant.confirmed, meant.rejected):
        with pytest.raises(
            TTRError, match=r"right: nothing can be seen in .* to learn"
        ):
            learn(gone)


# --- learning ------------------------------------------------------------------------


def test_a_correction_is_one_step_and_the_old_meaning_stays(to_the_right):
    seen = at(0.9, 0.1)
    after = to_the_right.rejected(seen)
    assert after.params.w == pytest.approx((0.8 - 0.9, 0.01 - 0.1))
    assert after.params.t == pytest.approx(0.09 + 1.0)
    assert after.classify(seen) is ~right("o1")
    assert to_the_right.params is LARSSON
    assert to_the_right.classify(seen) is right("o1")
    assert after.record.interp is INTERP


@pytest.mark.parametrize(
    ("method", "w", "t"),
    [
        (Perceptron(rate=0.1), (0.71, 0.0), 0.19),
        (Perceptron(rate=0.1, threshold_rate=0.0), (0.71, 0.0), 0.09),
        (Perceptron(rate=0.1, threshold_rate=0.01), (0.71, 0.0), 0.1),
    ],
)
def test_rates_of_weights_and_threshold(method, w, t):
    after = meaning(INTERP, method, LARSSON, of="pos").rejected(at(0.9, 0.1))
    assert after.params.w == pytest.approx(w)
    assert after.params.t == pytest.approx(t)


def test_what_is_right_already_changes_nothing(to_the_right):
    assert to_the_right.confirmed(at(0.9, 0.1)) is to_the_right
    assert to_the_right.rejected(at(-0.9, 0.1)) is to_the_right


def test_a_graded_perceptron_learns_by_how_wrong_it_is():
    method = GradedPerceptron(rate=0.5, steepness=2.0)
    before = meaning(INTERP, method, LARSSON, of="pos")
    seen = at(0.9, 0.1)
    said = 1 / (1 + math.exp(-2.0 * (0.721 - 0.09)))
    assert before.degree(seen).lo == pytest.approx(said)
    after = before.confirmed(seen)
    assert after.params.w[0] == pytest.approx(0.8 + 0.5 * (1 - said) * 0.9)
    assert after.params.t == pytest.approx(0.09 - 0.5 * (1 - said))
    assert after.degree(seen).lo > said > before.rejected(seen).degree(seen).lo


def test_a_graded_perceptron_never_overflows():
    method = GradedPerceptron(steepness=1e6)
    meant = meaning(INTERP, method, record(w=[1e9, 0], t=0), of="pos")
    assert [meant.degree(at(x, 0)).lo for x in (-1e9, 1e9)] == [
        pytest.approx(0, abs=1e-300),
        1.0,
    ]


def test_other_parameters_stay():
    params = record(w=[0.0, 0.0], t=0.0, taught_by="a")
    meant = meaning(INTERP, Perceptron(), params, of="pos").confirmed(at(1, 0))
    assert meant.params == record(w=[1.0, 0.0], t=-1.0, taught_by="a")


# --- mistakes ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("params", "pos", "wrong"),
    [
        (LARSSON, (1, 2, 3), "there are 2 weights, but the percept has 3 numbers"),
        (LARSSON, (1, math.nan), "a percept is a list of finite numbers, found [1"),
        (LARSSON, "o7", "a percept is a list of finite numbers, found o7"),
        (record(w=[1, "x"], t=0), (1, 2), "w is a list of finite numbers, found [1, x"),
        (record(w=[1, 2], t=()), (1, 2), "t is a finite number, found []"),
        (record(w=[1, 2], t="1"), (1, 2), 't is a finite number, found "1"'),
        (record(w=[1, 2]), (1, 2), "perceptron are {t = …, w = […]}, found {w = "),
    ],
)
def test_percepts_and_parameters_that_do_not_fit(params, pos, wrong):
    meant = meaning(INTERP, Perceptron(), params, of="pos")
    r = record(foo="o1", spkr="a", pos=pos)
    for ask in (meant.degree, meant.confirmed, meant.rejected, meant.score):
        with pytest.raises(TTRError) as refused:
            ask(r)
        assert refused.value.message.startswith("right: ")
        assert wrong in refused.value.message


def test_a_situation_without_the_percept_or_what_the_word_is_said_of(to_the_right):
    with pytest.raises(TTRError, match=r"right: .* at pos, which {foo = o1} lacks"):
        to_the_right.degree(record(foo="o1"))
    with pytest.raises(TTRError, match=r"right: the path .*foo leads nowhere"):
        to_the_right.classify(record(pos=[1, 2]))
    with pytest.raises(TTRError, match="right is said of a record, found o1"):
        to_the_right.degree("o1")


class Odd:
    """A method that answers with what it was made of, or raises it."""

    def __init__(self, answer):
        self.answer = answer

    def __str__(self):
        return "an odd method"

    def degree(self, params, x):
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer

    confirmed = rejected = degree


@pytest.mark.parametrize(
    ("answer", "wrong"),
    [
        (math.nan, "right: a degree is a number in .* found nan"),
        (1.5, "right: a degree is a number in .* found 1.5"),
        ((0.6, 0.4), "right: a degree is a number in .* found"),
        ("yes", "right: a degree is a number in .* found 'yes'"),
        (None, "right: a degree is a number in .* found None"),
        (ValueError("dark"), r"right: an odd method failed on \[1\]: ValueError: dark"),
        (TTRError("too dark"), "right: too dark"),
    ],
)
def test_a_method_that_fails(answer, wrong, M):
    meant = meaning(INTERP, Odd(answer), record(), of="pos")
    with pytest.raises(TTRError, match=wrong):
        meant.degree(at(1))
    with pytest.raises(TTRError, match="right"):
        meant.judge(M, at(1))


@pytest.mark.parametrize("answer", [ValueError("dark"), 0.5, None])
def test_a_method_that_fails_to_learn_leaves_the_meaning_as_it_is(answer):
    meant = meaning(INTERP, Odd(answer), record(), of="pos")
    before = str(meant)
    with pytest.raises(TTRError, match=r"right: an odd method failed|a record, found"):
        meant.confirmed(at(1))
    assert str(meant) == before


def test_eyes_that_fail():
    def blind(pos):
        raise OSError("no light")

    meant = meaning(INTERP, Perceptron(), LARSSON, of="pos", through=blind)
    with pytest.raises(TTRError, match=r"right: the percept of \[1\] .* OSError: no"):
        meant.degree(at(1))


def test_what_has_no_score_or_does_not_learn():
    meant = meaning(INTERP, Projective(), record(axis=[1, 0]), of="pos")
    with pytest.raises(
        UnsupportedError, match="right: a spatial template has degrees, but"
    ):
        meant.score(at(1, 0))
    with pytest.raises(
        UnsupportedError, match="right: a spatial template does not learn"
    ):
        meant.confirmed(at(1, 0))


@pytest.mark.parametrize(
    ("method", "shown"),
    [
        (Perceptron(), "a perceptron"),
        (Perceptron(0.5), "a perceptron at the rate 0.5"),
        (Perceptron(1.0, 0.0), "a perceptron at the rates 1 and 0"),
        (GradedPerceptron(), "a graded perceptron, steepness 10"),
    ],
)
def test_a_method_prints_what_it_goes_by(method, shown):
    assert str(method) == shown


@pytest.mark.parametrize("wrong", [-1.0, math.nan, math.inf, "fast", None])
@pytest.mark.parametrize(
    "make",
    [
        lambda x: Perceptron(rate=x),
        lambda x: GradedPerceptron(rate=x),
        lambda x: GradedPerceptron(steepness=x),
        lambda x: Perceptron(threshold_rate="fast" if x is None else x),
        lambda x: Projective(sharpness=x),
    ],
)
def test_rates_that_are_none(make, wrong):
    with pytest.raises(TTRError, match=r"above 0, found|0 or more, found|finite numb"):
        make(wrong)


@pytest.mark.parametrize("dimensions", [0, -1, 2.0, "2", True])
def test_percepts_have_a_dimension(dimensions):
    with pytest.raises(TTRError, match="a percept has 1 number or more, found"):
        blank(dimensions)


@pytest.mark.parametrize(
    ("given", "wrong"),
    [
        ({"method": "perceptron"}, "but perceptron lacks degree, confirmed, rejected"),
        ({"of": 5}, "a path or a tuple of paths, as in 'pos', found 5"),
        ({"of": ()}, r"a path or a tuple of paths, as in 'pos', found \[\]"),
        ({"of": ("pos", 1)}, r"a path or a tuple of paths, .* found \[pos, 1\]"),
        ({"through": "eyes"}, "a percept is seen through a function, found eyes"),
        ({"interp": Ind}, "the bg of a meaning is a record type, found Ind|interp"),
        ({"params": 5}, "the params of a meaning is a record, found 5"),
    ],
)
def test_what_no_meaning_can_be_made_of(given, wrong):
    parts = {"interp": INTERP, "method": Perceptron(), "params": LARSSON, "of": "pos"}
    with pytest.raises(TTRError, match=wrong):
        meaning(**{**parts, **given})


def test_weights_out_of_bounds_are_refused(to_the_right):
    meant = meaning(INTERP, Perceptron(rate=1e308), LARSSON, of="pos")
    with pytest.raises(
        TTRError, match=r"right: a step at rate 1e.308 makes the weights infinite"
    ):
        meant.rejected(at(1e10, 0))


def test_the_fixed_point_type_of_the_interpretation_is_the_type(to_the_right):
    assert to_the_right.type is fix(INTERP)
