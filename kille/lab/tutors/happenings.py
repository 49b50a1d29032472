"""What a tutor does besides talking: things are moved, looks taken, the robot cut off.

Each is an event that the games take: a look on the robot's own turn, or on the tutor's,
a look in silence, and that the robot was spoken over.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import chain, product
from random import Random

from hypothesis import strategies as st

from kille.lab.worlds.perception import glance_event, look_event, watch_event
from kille.lab.worlds.worlds import World
from ttr import Record, record

Look = tuple[Callable[[World, World], Record], World]

SILENCES = ((0.5, 0.5), (3.0, 3.0), (20.0, 0.5), (20.0, 20.0))
"""For how many seconds nobody has spoken, and all has been still."""


def sample_happenings(world: World) -> st.SearchStrategy[Record]:
    """Sample something that may happen, as the event in which it is seen.

    Each kind of thing happens as often as any other.
    """
    looks = (glance_event, look_event)
    kinds = [sample_looks(world, list(product(looks, it))) for it in _kinds(world)]
    return st.one_of(kinds)


def sample_idle_looks(world: World) -> st.SearchStrategy[Record]:
    """Sample looks on the robot's own turn: all is as it was, or has changed.

    What is pointed at is the tutor's to speak of.
    """
    return sample_looks(
        world, [(look_event, it) for it in _worlds_without_pointing(world)]
    )


def sample_silences(world: World) -> st.SearchStrategy[Record]:
    """Sample looks while nobody speaks: as often all is as it was as it has changed."""
    same, *changed = _worlds_without_pointing(world)
    seen = list(product([*[same] * len(changed), *changed], SILENCES))
    return st.sampled_from(seen).map(lambda it: watch_event(it[0], world, *it[1]))


def sample_looks(world: World, after: Sequence[Look]) -> st.SearchStrategy[Record]:
    """Sample one of these looks, as an event."""
    return st.sampled_from(after).map(lambda one: one[0](one[1], world))


def interruptions(s: Record) -> Sequence[Record]:
    """That the robot was cut off in what it has just said, at the end or before it."""
    latest, said = s.shared.latest, s.private.last
    if s.shared.cut or not said or "e" not in latest or latest.spkr != "robot":
        return ()
    at_end = record(unsaid=said[-1:], uttered="…", latest=latest)
    before = record(unsaid=said, uttered="", latest=record())
    return (at_end, before) if len(said) == 1 else (at_end,)


def _worlds_without_pointing(world: World) -> Sequence[World]:
    """What may become of a world while the tutor points at nothing else."""
    same = [it for it in happenings(world) if it.focus == world.focus]
    return [world.look_again(), *same]


def happenings(world: World) -> tuple[World, ...]:
    """What may become of a world: things are put, taken, moved, pointed at."""
    return tuple(chain.from_iterable(_kinds(world)))


@lru_cache(256)
def _kinds(world: World) -> Sequence[Sequence[World]]:
    """What may become of a world, kind by kind."""
    random = Random(world.name)
    free = list(world.free_places())
    hidden = [n for n in range(1, len(world.things) + 1) if n not in world.in_view]
    kinds = [
        [world.look_again()],
        [world.flip_depth()],
        [world.clear()],
        [world.point_at(number) for number in world.in_view],
        [world.move(number, random.choice(free)) for number in hidden],
    ]
    if world.in_view:
        one, other = random.choices(world.in_view, k=2)
        kinds += [[world.move(one, None)], [world.move(other, random.choice(free))]]
    return tuple(kind for kind in kinds if kind)
