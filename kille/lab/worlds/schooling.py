"""Robots that have been to school: games that begin when some lessons have been given.

What needs many words is talked of only in long dialogues with a robot that has none.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import permutations

from kille.dialogue.state import initial
from kille.dialogue.state import words as words_of
from kille.lab.worlds.games import learned_words as learned
from kille.lab.worlds.games import world_of
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.sayings import (
    THIS,
    Claim,
    WorldTalk,
    cue_matter,
    generic_matter,
    subsumption_matter,
)
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.worlds import World
from ttr import Record, record
from ttr import replace as updated
from ttr.aliases import former_names
from ttr.updates import Game

__all__ = [
    "lessons",
    "game_next_day",
    "continue_game",
    "game_after_school",
    "kinds_told",
]

__getattr__ = former_names(
    __name__,
    {
        "schooled": "game_after_school",
        "resumed": "continue_game",
        "rested": "game_next_day",
    },
)


def game_after_school(game: Game, language: str = "en", times: int = 1) -> Game:
    """A game whose robot was told so often what it sees, and where things are.

    After school the table was cleared and laid again, and all that anybody has said of
    the things that are now in view is which way one of them faces.

    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import draw_world
    >>> after = game_after_school(simulated_game(draw_world(1)))
    >>> [sign.form for sign in after.start.private.nouns]
    ['box', 'bowl', 'car', 'cup']
    """
    world = world_of(game.start)
    given: list[str | Record] = []
    for _ in range(times):
        given += lessons(language, world)
        world = world.look_again()
    cleared = world.clear()
    laid = replace(world, glance=cleared.glance + 1)
    given += [glance_event(cleared, world), glance_event(laid, cleared)]
    facing = WorldTalk(vocabulary(language), laid).sayings("orient")[-1:]
    return continue_game(game, [*given, *(one.text for one in facing)])


def lessons(language: str, world: World) -> Iterator[str | Record]:
    """Lessons what each thing in view is, and then where they are, once a word.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> [it for it in lessons("en", world) if isinstance(it, str)]
    ['This is a cup.']
    """
    talk = WorldTalk(vocabulary(language), world)
    for x in world.in_view:
        yield glance_event(world.point_at(x), world)
        claim = Claim(talk.words.noun_of(world, x), THIS)
        yield talk.say("instruct", claim).text
    said: set[Record] = set()
    for x, y in permutations(world.in_view, 2):
        relation = talk.relation(x, y)
        if relation is None or relation in said:
            continue
        said.add(relation)
        yield glance_event(world.point_at(x), world)
        claim = Claim(relation, THIS, talk.phrases(y)[-1])
        yield talk.say("relate", claim).text


def kinds_told(language: str, nouns: Sequence[Record]) -> Iterator[str]:
    """Lessons that the first of some nouns are of another kind, and how they are.

    >>> from kille.lab.worlds.vocabulary import vocabulary
    >>> words = vocabulary("en").nouns
    >>> list(kinds_told("en", [words["mug"], words["cup"]]))[0]
    'A mug is a kind of cup.'
    """
    lower, upper, *_ = nouns
    talk = WorldTalk(vocabulary(language), World())
    quality = talk.words.colours[0]
    for act, matter in (
        ("classify", subsumption_matter(lower, upper)),
        ("generalise", generic_matter(lower, "Generally", quality=quality)),
        ("weigh_cue", cue_matter(lower, "shape", False)),
    ):
        yield talk.say(act, matter).text


def continue_game(game: Game, given: Iterable[str | Record]) -> Game:
    """The game as it goes on after these texts and looks.

    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> after = continue_game(game, ["This is a cup."])
    >>> [sign.form for sign in after.start.private.nouns]
    ['cup']
    """
    now = game.begin()
    for one in given:
        heard = game.hear(one) if isinstance(one, str) and game.hear else one
        now = game.take(now, heard).run
    return replace(game, start=now.state, model=now.model)


def game_next_day(game: Game) -> Game:
    """The game on another day: it is known what was taught, but not what was said.

    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> morning = game_next_day(continue_game(game, ["This is a cup."]))
    >>> [sign.form for sign in morning.start.private.nouns]
    ['cup']
    """
    known, s = game.start, initial(words_of(game.start), game.start.private.strategy)
    taught = [
        record(sign=it.sign, lessons=float(sum(x.holds for x in it.lessons)))
        for it in learned(game.model)
        if it.lessons
    ]
    changes = {
        "private.taught": taught,
        "private.kinds": _of_earlier(known.private.kinds),
        "private.criteria": _of_earlier(known.private.criteria),
        "private.colours": known.private.colours,
        "view": known.view,
    }
    return replace(game, start=updated(s, changes))


def _of_earlier(said: Iterable[Record]) -> list[Record]:
    """What was said of kinds, as it is remembered of another dialogue."""
    return [updated(it, after=-1.0) for it in said]
