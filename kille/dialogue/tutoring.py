"""Tutoring as a game: its rules with a start, a language and an agenda, to be played.

It is what the robot plays, without its eyes and its memory: a look is an event like any
other, and the model says what words are true of. So the rules can be checked, tested
and changed by themselves.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from kille.dialogue.games import TUTORING
from kille.dialogue.language import Sentence, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    DialogueTypes,
    packaged_types,
    predicate_at,
)
from kille.dialogue.rules import bind
from kille.dialogue.state import blank_model, initial
from kille.dialogue.strategies import strategy
from kille.dialogue.taxonomy import under_kinds
from kille.dialogue.wording import say as worded
from ttr import Model, Record, RecordType
from ttr.aliases import former_names
from ttr.judging import Judgement
from ttr.updates import Algorithm, Game, NBest, nbest
from ttr.updates.games import Act

__getattr__ = former_names(__name__, {"heard": "hear_sentences"})

__all__ = ["hear", "hear_sentences", "say", "tutoring"]


def tutoring(
    signs: Iterable[Record] = (),
    *,
    language: str = "en",
    rules: Algorithm = TUTORING,
    model: Model | None = None,
    act: Act | None = None,
    mode: str = "",
    wording: str = "",
    turns: str = "",
    colours: Iterable[Record] = (),
    taught: Iterable[Record] = (),
    kinds: Iterable[Record] = (),
    criteria: Iterable[Record] = (),
    types: DialogueTypes | None = None,
) -> Game:
    """The games of tutoring as one, by a robot that knows these words.

    `model` judges what they are true of, by witness functions of their predicates;
    `act` makes a planned move, where more is to be done for it than to create it.
    `mode`, `wording` and `turns` name its strategy in `strategies.toml`; `colours` are
    those of its adjectives that are colours; `taught` says of words in how many lessons
    they were taught before, `kinds` which kinds of things are kinds of others,
    `criteria` by what they are known. `types` are those of its theory, by default the
    packaged one; rules that name types are bound to them.

    >>> game = tutoring()
    >>> turn = game.take(game.begin(), game.hear("What is this?"))
    >>> [game.say(move) for move in turn.said]
    ['I see nothing on the table.']
    """
    types = types or packaged_types()
    deciding, kinds = strategy(mode, wording, language, turns), tuple(kinds)
    return Game(
        "tutoring",
        types.record_type("State"),
        initial(signs, deciding, colours, taught, kinds, criteria),
        bind(rules, types),
        under_kinds(blank_model(types) if model is None else model, kinds, types=types),
        agenda="private.agenda",
        hears=(
            types["Heard"],
            types["Seen"],
            types["Glance"],
            types["Watched"],
            types["Interrupted"],
        ),
        act=act,
        hear=partial(hear, language=language, types=types),
        say=partial(say, language=language, wording=deciding.wording),
        theory=types.theory,
    )


def hear(
    text: str, language: str = "en", *, types: DialogueTypes | None = None
) -> RecordType | NBest | None:
    """The event of saying this, or None if it is not understood.

    Of several sentences it is the first.

    >>> event = hear("This is a cup.")
    >>> print(event["e"])
    instruct(.spkr, .addr)
    """
    return hear_sentences(understand(text, language, types=types)[0])


def hear_sentences(
    *sentences: Sentence, p: Iterable[float] = (1.0,)
) -> RecordType | NBest | None:
    """The event that one of these sentences was said, each so probable.

    Its alternatives are all the ways in which they can be read.

    >>> from kille.dialogue.language import understand
    >>> [cup], [cap] = understand("This is a cup."), understand("This is a cap.")
    >>> [round(p, 1) for _, p in hear_sentences(cup, cap, p=(0.7, 0.2))]
    [0.7, 0.2]
    """
    weighed = [
        (reading.type, q * share)
        for said, q in zip(sentences, p, strict=True)
        for reading, share in zip(said.readings, shares(said), strict=True)
    ]
    match weighed:
        case []:
            return None
        case [(said, 1.0)]:
            return said
    return nbest(*weighed)


def shares(said: Sentence) -> tuple[float, ...]:
    """How probable each reading of a sentence is; together they are certain.

    >>> [said] = understand("The red.")
    >>> sum(shares(said))
    1.0
    """
    weights = said.weights or (1.0,) * len(said.readings)
    return tuple(it / sum(weights) for it in weights)


def say(move: Judgement, language: str = "en", wording: str = "paper") -> str:
    """The robot's sentence for a move of its own.

    Raises `TypeError` for anything else.

    >>> game = tutoring()
    >>> turn = game.take(game.begin(), game.hear("Hello."))
    >>> say(turn.said[0])
    'Hello.'
    """
    planned, made = move.type, move.sit
    if not isinstance(planned, RecordType) or not isinstance(made, Record):
        raise TypeError(f"a move is a record of a record type, but found {move}")
    act = predicate_at(planned, "e").name
    return worded(lexicon(language, wording), act, made)
