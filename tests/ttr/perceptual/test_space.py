"""Points are made individuals, and their places are judged in frames of reference."""

import math

import pytest

from ttr import Ind, Model, Pred, TTRError, fun, record, rectype, this
from ttr.errors import RefusedError
from ttr.semantics.perceptual import (
    INDIVIDUATE,
    Frame,
    Perceptron,
    PointMap,
    Points,
    Projective,
    RealVector,
    absolute,
    blank,
    clusters,
    coordinates,
    detections,
    individuate,
    interpretation,
    intrinsic,
    meaning,
    relative,
)
from ttr.semantics.perceptual.vectors import is_vector

cup, book = Pred("cup", Ind), Pred("book", Ind)
SCENE = PointMap(
    [(x / 10, y / 10) for x in range(3) for y in range(3)]
    + [(3 + x / 10, y / 10) for x in range(9) for y in range(2)]
)


def shaped(pred, w, t):
    """A word for regions, judged by how wide and how deep they are."""
    T = rectype(x=Ind, reg=Points, c=pred(this.x))
    interp = interpretation(T, "c")
    params = record(w=w, t=t)
    return meaning(interp, Perceptron(), params, of="reg", through=lambda reg: reg.size)


CUP, BOOK = shaped(cup, [-1, 0], -0.5), shaped(book, [1, 0], 0.5)

# --- regions -------------------------------------------------------------------------


def test_a_point_map_prints_as_how_many_points_it_has():
    assert str(record(reg=SCENE)) == "{reg = <PointMap 27>}"
    assert PointMap([[0, 1]]) == PointMap(((0.0, 1.0),))
    assert PointMap([[0, 1], [2, 3]]).centre == (1.0, 2.0)
    assert PointMap([[0, 1], [2, 4]]).size == (2.0, 3.0)


@pytest.mark.parametrize(
    ("points", "wrong"),
    [
        ([], "one point or more, all with as many numbers, found no points"),
        ([[1, 2], [1]], "found 1, 2"),
        ([[1, math.inf]], "a point is a list of finite numbers, found"),
        (5, "a point is a list of finite numbers, found 5"),
        (["ab"], "a point is a list of finite numbers, found ab"),
    ],
)
def test_what_is_no_point_map(points, wrong):
    with pytest.raises(TTRError, match=wrong):
        PointMap(points)


def test_regions_are_what_short_steps_join():
    assert [len(it) for it in clusters(SCENE, 0.5)] == [9, 18]
    assert len(clusters(SCENE, 0.05)) == 27
    assert clusters(SCENE, 5.0) == (SCENE,)
    with pytest.raises(TTRError, match="the reach of a step is above 0"):
        clusters(SCENE, 0)


def test_many_points_in_one_region_are_no_matter():
    line = PointMap([(x / 10, 0.0) for x in range(20_000)])
    assert clusters(line, 0.15) == (line,)
    assert clusters(line, 1e4) == (line,)


def test_a_detector_finds_what_words_say():
    small, wide = detections(clusters(SCENE, 0.5), CUP, BOOK)
    assert str(small) == r"{p = 1.0, pfun = \x:Ind. cup(x), reg = <PointMap 9>}"
    assert wide.pfun is fun(x=Ind)(book(this.x))
    assert detections(clusters(SCENE, 0.5), CUP) == (small,)
    assert detections(clusters(SCENE, 0.5)) == ()


def test_individuation_is_a_function_of_the_theory():
    assert str(INDIVIDUATE) == (
        r"\r:[pfun : (Ind -> Type), reg : PointMap]. "
        "[a : Ind, loc = r.reg : PointMap, c : r.pfun(a)]"
    )


def test_individuals_are_assumed_for_regions():
    M = Model()
    found = []
    for region in detections(clusters(SCENE, 0.5), CUP, BOOK):
        sit, T, M = individuate(M, region)
        found.append((sit, T))
    (one, Cup), (two, Book) = found
    assert one.a != two.a
    assert str(Cup) == "[a : Ind, loc = <PointMap 9> : PointMap, c : cup(a)]"
    assert M.judge(one, Cup).holds
    assert M.judge(two, Book).holds
    assert M.judge(one.c, book(one.a)).holds is False
    assert M.witnesses(Ind) == (one.a, two.a)


def test_what_is_no_region():
    with pytest.raises(RefusedError, match="takes objects of"):
        individuate(Model(), record(reg="here", pfun=fun(x=Ind)(cup(this.x))))
    with pytest.raises(RefusedError, match="takes objects of"):
        individuate(Model(), record(reg=SCENE))


def test_a_property_with_more_to_it_is_kept_as_it_is():
    whole = fun(x=Ind)(cup(this.x) & book(this.x))
    sit, T, M = individuate(Model(), record(reg=SCENE, pfun=whole))
    assert M.judge(sit, T).holds
    assert M.judge(sit.c, cup(sit.a)).holds


# --- frames --------------------------------------------------------------------------


def test_frames_are_records_of_a_type():
    M = Model().witnessed(RealVector, by=is_vector)
    for frame in (
        absolute([0, 0]),
        intrinsic([1, 1], [0, 3]),
        relative([0, 1], [5, 5]),
    ):
        assert M.judge(frame, Frame).holds
        right, front = frame.axes.right, frame.axes.front
        assert math.hypot(*right) == pytest.approx(1.0)
        assert right[0] * front[0] + right[1] * front[1] == pytest.approx(0.0)


def test_whose_right_it_is():
    """A chair at the origin faces east; a ball is south of it; I look from north."""
    ball = [0, -1]
    assert coordinates(ball, intrinsic([0, 0], facing=[1, 0])) == (1.0, 0.0)
    assert coordinates(ball, relative([0, 0], viewer=[0, 5])) == (0.0, -1.0)
    assert coordinates([-1, 0], relative([0, 0], viewer=[0, 5])) == (1.0, 0.0)
    assert coordinates(ball, absolute([0, 0])) == (0.0, -1.0)


def test_a_ground_that_is_a_region_is_where_its_centre_is():
    ground = PointMap([[0, 0], [2, 2]])
    assert coordinates(PointMap([[3, 1], [5, 1]]), absolute(ground)) == (3.0, 0.0)


@pytest.mark.parametrize(
    ("ask", "wrong"),
    [
        (lambda: relative([1, 1], [1, 1]), "the way to the viewer leads nowhere"),
        (lambda: intrinsic([1, 1], [0, 0]), "facing leads nowhere: its length is 0"),
        (lambda: absolute([1, 1, 1]), "the ground is a point of a plane, found"),
        (lambda: absolute("here"), "the ground is a list of finite numbers, found her"),
        (lambda: coordinates([0, 0], record(x=1)), "a frame is a record {origin, axes"),
    ],
)
def test_what_is_no_frame(ask, wrong):
    with pytest.raises(TTRError, match=wrong):
        ask()


# --- a spatial word over two individuals in a frame ----------------------------------


Place = rectype(a=Ind, loc=Points)
right = Pred("right", Ind, Ind)
RIGHT = rectype(x=Place, y=Place, frame=Frame, c=right(this.x.a, this.y.a))


def test_a_spatial_word_is_judged_over_two_regions_in_a_frame():
    meant = meaning(
        interpretation(RIGHT, "c"),
        Projective(sharpness=2.0),
        record(axis=[1, 0]),
        of=("x.loc", "frame"),
        through=coordinates,
    )
    M = Model()
    small, wide = detections(clusters(SCENE, 0.5), CUP, BOOK)
    one, _, M = individuate(M, small)
    two, _, M = individuate(M, wide)
    for viewer, is_right in (([0, -9], True), ([0, 9], False)):
        frame = relative(one.loc, viewer)
        r = record(
            x=record(a=two.a, loc=two.loc), y=record(a=one.a, loc=one.loc), frame=frame
        )
        angle = math.atan2(*reversed(coordinates(two.loc, frame)))
        assert meant.degree(r).lo == pytest.approx(max(0.0, math.cos(angle)) ** 2)
        assert (meant.degree(r).lo > 0.5) is is_right
        j = meant.judge(M, r)
        assert j.p == meant.degree(r)


def test_a_spatial_word_can_be_learned_from_the_same_coordinates():
    meant = meaning(
        interpretation(RIGHT, "c"),
        Perceptron(),
        blank(2),
        of=("x.loc", "frame"),
        through=coordinates,
    )

    def seen(*place):
        x = record(a="o1", loc=PointMap([place]))
        y = record(a="o2", loc=PointMap([(0, 0)]))
        return record(x=x, y=y, frame=relative([0, 0], viewer=[0, -9]))

    for _ in range(5):
        meant = meant.confirmed(seen(1, 0)).rejected(seen(-1, 0)).rejected(seen(0, 0))
    assert meant.classify(seen(2, 0)) is right("o1", "o2")
    assert meant.classify(seen(-2, 0)) is ~right("o1", "o2")


def test_a_template_and_its_mistakes():
    template = Projective()
    assert template.degree(record(axis=[0, 1]), [0.0, 0.0]) == 0.0
    assert template.degree(record(axis=[0, 1]), [0.0, -2.0]) == 0.0
    with pytest.raises(TTRError, match=r"a spatial template has {axis = \[…\]}, found"):
        template.degree(record(), [0, 1])
    with pytest.raises(TTRError, match="the axis has 3 numbers, but the percept 2"):
        template.degree(record(axis=[0, 1, 1]), [0, 1])
