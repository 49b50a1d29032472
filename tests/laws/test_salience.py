"""Laws of salience: it is a degree, it fades, and what is mentioned or shown gains."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.meanings import record_type
from kille.dialogue.reference.salience import (
    BEFORE,
    combined_salience,
    notice,
    notice_in_view,
    saliences,
    set_salience,
    thing_saliences,
)
from kille.dialogue.state import blank_model, initial
from ttr import Record, record, replace

THINGS = ("o1", "o2", "o3")
TALK = ("target", "landmark", "inside")

degrees = st.floats(0, 1)
sights = st.builds(
    lambda x, size, centrality, nearness: record(
        x=x, size=size, centrality=centrality, nearness=nearness
    ),
    st.sampled_from(THINGS),
    *[degrees] * 3,
)
events = st.tuples(st.sampled_from(THINGS), st.sampled_from((*TALK, "shown", "new")))
histories = st.lists(st.none() | events, max_size=12)
"""What happens: a thing is attended to in a role, or another move is made."""

numbers = st.floats(0, 2)
weights = st.fixed_dictionaries(
    {
        **{f"{it}": numbers for it in ("visual", "linguistic")},
        "decay": degrees,
        **{f"sights.{it}": numbers for it in ("size", "centrality", "nearness", "new")},
        **{f"roles.{it}": degrees for it in (*TALK, "shown")},
    }
)


def state(
    history: list[Any],
    seen: list[Record] | None = None,
    weighed: dict[str, float] | None = None,
) -> Record:
    """The state after these things have happened, in front of the things."""
    s = replace(initial(), {"view.things": THINGS, "shared.sights": seen or []})
    for name, value in (weighed or {}).items():
        s = replace(s, {f"private.strategy.salience.{name}": value})
    for it in history:
        s = after_move(s) if it is None else attend_to(s, *it)
    return s


def after_move(s: Record) -> Record:
    return replace(s, {"private.cost.turns": s.private.cost.turns + 1.0})


def attend_to(s: Record, x: str, role: str) -> Record:
    move = s.private.cost.turns + (0.0 if role in TALK else BEFORE)
    noticed = notice(s.shared.noticed, {x: role}, move)
    return replace(s, {"shared.noticed": noticed})


def is_shown(s: Record, x: str) -> bool:
    return next(it.is_shown for it in thing_saliences(s) if it.x == x)


@given(histories, st.lists(sights, max_size=3), weights)
def test_salience_is_a_degree(
    history: list[Any], seen: list[Record], weighed: dict[str, float]
) -> None:
    s = state(history, seen, weighed)
    for it in thing_saliences(s):
        assert 0.0 <= it.visual <= 1.0
        assert 0.0 <= it.linguistic <= 1.0
    assert all(0.0 <= degree <= 1.0 for degree in saliences(s).values())
    assert saliences(s).keys() == set(THINGS)


@given(histories, st.lists(sights, max_size=3))
def test_the_facts_and_the_degrees_are_of_their_types(
    history: list[Any], seen: list[Record]
) -> None:
    s = set_salience(state(history, seen))
    model = blank_model()
    for x in THINGS:
        model = model.given(x, record_type("Notice")["x"])
    assert model.judge(s, record_type("State")).holds


@given(histories, st.lists(sights, max_size=3), weights, st.integers(1, 5))
def test_what_is_not_mentioned_fades(
    history: list[Any], seen: list[Record], weighed: dict[str, float], moves: int
) -> None:
    s = state(history, seen, weighed)
    for _ in range(moves):
        later = after_move(s)
        for was, now in zip(thing_saliences(s), thing_saliences(later), strict=True):
            assert now.linguistic <= was.linguistic
            assert now.visual <= was.visual
        assert all(
            degree <= saliences(s)[x] + 1e-12 for x, degree in saliences(later).items()
        )
        s = later


@given(histories, st.lists(sights, max_size=3), weights, st.sampled_from(THINGS))
def test_to_be_mentioned_makes_no_less_salient(
    history: list[Any], seen: list[Record], weighed: dict[str, float], x: str
) -> None:
    s = state(history, seen, weighed)
    for role in TALK:
        mentioned = attend_to(s, x, role)
        assert saliences(mentioned)[x] >= saliences(s)[x]
        assert all(saliences(mentioned)[y] == saliences(s)[y] for y in THINGS if y != x)


@given(histories, st.lists(sights, max_size=3), st.sampled_from(THINGS))
def test_to_be_said_something_of_makes_more_salient(
    history: list[Any], seen: list[Record], x: str
) -> None:
    """It gains, but where it is pointed at, and is the most salient in the talk."""
    s = after_move(state(history, seen))
    mentioned = attend_to(s, x, "target")
    said = {it.x: it.linguistic for it in thing_saliences(mentioned)}
    assert said[x] == max(said.values())
    assert saliences(mentioned)[x] > saliences(s)[x]


@given(histories, st.lists(sights, max_size=3), st.sampled_from(THINGS))
def test_what_is_pointed_at_is_the_most_salient(
    history: list[Any], seen: list[Record], x: str
) -> None:
    s = after_move(state(history, seen))
    noticed = notice_in_view(s, [x], (), THINGS)
    shown = replace(s, {"shared.noticed": noticed})
    margin = s.private.strategy.salience.margin
    assert saliences(shown)[x] == 1.0
    assert all(saliences(shown)[y] < 1.0 - margin for y in THINGS if y != x)
    assert not is_shown(after_move(shown), x)


@given(histories, st.lists(sights, max_size=3), degrees, degrees, degrees)
def test_more_to_see_or_to_hear_of_a_thing_makes_no_less_salient(
    history: list[Any], seen: list[Record], less: float, more: float, other: float
) -> None:
    weighed = initial().private.strategy.salience
    low, high = sorted((less, more))
    for it in thing_saliences(state(history, seen)):
        for name in ("visual", "linguistic"):
            rest = it._replace(visual=other, linguistic=other)
            below = combined_salience(rest._replace(**{name: low}), weighed)
            above = combined_salience(rest._replace(**{name: high}), weighed)
            assert below <= above + 1e-12


@given(histories)
def test_what_nobody_knows_how_it_looks_is_salient_by_the_talk_alone(
    history: list[Any],
) -> None:
    said = [it for it in history if it is None or it[1] in TALK]
    s = state(said)
    found = thing_saliences(s)
    assert len({it.visual for it in found}) == 1
    order = sorted(THINGS, key=lambda x: -saliences(s)[x])
    by_talk = {it.x: it.linguistic for it in found}
    assert [by_talk[x] for x in order] == sorted(by_talk.values(), reverse=True)
