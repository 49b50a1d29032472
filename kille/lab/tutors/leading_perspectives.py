"""What leads on to perspectives: things that face some way, and where others stand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

from kille.lab.worlds.sayings import Claim, Phrase, Saying, WorldTalk

Sayings = Sequence[Saying]

OF_PLACES = ("relate", "correct", "reject", "ask_whether")
"""The moves that claim a relation, or ask for one."""


def front_topics(
    talk: WorldTalk, fronts: Sequence[tuple[int, str]]
) -> Sequence[Sayings]:
    """Sayings about perspectives, if things face some way, or that they do."""
    turned = [(y, front) for y, front in fronts if y in talk.world]
    if not turned:
        return [talk.sayings("orient")] if len(talk.world.in_view) > 1 else []
    beside = list(_claims_beside(talk, turned))
    claims = [[place_saying(talk, act, it) for it in beside] for act in OF_PLACES]
    phrases = [Phrase("", (it.sign, *it.landmark.signs)) for it in beside if it.sign]
    asked = [
        talk.say(act, Claim(None, phrase))
        for act in ("ask_name", "ask_find")
        for phrase in phrases
    ]
    places = [
        talk.say("ask_place", Claim(None, talk.colour_phrase(x)))
        for x in talk.world.in_view
    ]
    taking = (
        talk.sayings("take_frame"),
        perspectives_by_side(talk),
    )
    return [said for said in (*claims, asked, places, places, *taking) if said]


def _claims_beside(
    talk: WorldTalk, turned: Sequence[tuple[int, str]]
) -> Iterator[Claim]:
    """Where things are beside what faces some way: for a viewer, and for itself."""
    for y, front in turned:
        for x, way in product(talk.world.in_view, ("away", front)):
            relation = None if x == y else talk.relation(x, y, way)
            if relation is not None:
                pair = colour_phrases(talk, x, y)
                yield Claim(relation, *pair)


def perspectives_by_side(talk: WorldTalk) -> Sayings:
    """Whose perspective is meant, where nobody is named but the robot and the thing."""
    taking = talk.sayings("take_frame")
    return [one for one in taking if not one.about.signs]


def colour_phrases(talk: WorldTalk, x: int, y: int) -> tuple[Phrase, Phrase]:
    """Phrases for two things in words that are known anyhow."""
    return talk.colour_phrase(x), talk.colour_phrase(y)


def place_saying(talk: WorldTalk, act: str, claim: Claim) -> Saying:
    """What is said of places by way of a move; who rejects something denies it."""
    return talk.say(act, replace(claim, denies=act == "reject"))
