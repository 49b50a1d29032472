"""What leads on to kinds: which is a kind of which, by what they are known, and parts.

What speaks against an axiom has to be taught of one thing first; what follows from it,
and what contradicts it, can be said only when it is known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import permutations, product
from typing import NamedTuple

from kille.dialogue.beliefs import knows
from kille.dialogue.criteria import COMPONENT, SUBJECT
from kille.dialogue.meanings import is_denial
from kille.dialogue.reference import thing_at
from kille.lab.worlds.perception import thing
from kille.lab.worlds.sayings import (
    THIS,
    Claim,
    Phrase,
    Saying,
    WorldTalk,
    cue_matter,
    generic_matter,
    subsumption_matter,
    synonymy_matter,
)
from ttr import Record

Sayings = Sequence[Saying]
Pair = tuple[Record, Record]


class KindSituation(NamedTuple):
    """The part of a state that decides what may be said of kinds.

    `kinds` are those that are kinds of others, `opposed` those of which one was said to
    be true of something and the other not; `named` is what was said that the thing is
    that is attended to, `subjects` of what was said by what it is known, `parts` are
    nouns for parts only, `nouns` those that are known.
    """

    talk: WorldTalk
    kinds: tuple[Pair, ...]
    opposed: tuple[Pair, ...]
    named: tuple[Record, ...]
    subjects: tuple[Record, ...]
    parts: tuple[Record, ...]
    nouns: tuple[Record, ...]


def kind_situation(talk: WorldTalk, s: Record) -> KindSituation:
    """The situation of a tutor who may speak of kinds."""
    private, attended = s.private, talk.world.attended_thing
    here = [it for it in private.lessons if it.content in s.shared.here]
    names = [it for it in here if it.sign.kind == "noun"]
    said = [it for it in names if not is_denial(it.content)]
    denied = [it for it in names if is_denial(it.content)]
    opposed = (
        (one.sign, other.sign)
        for one, other in product(said, denied)
        if thing_at(one.content, "target") == thing_at(other.content, "target")
    )
    x = None if attended is None else thing(attended)
    contents = [(it.content, it.signs) for it in private.criteria]
    return KindSituation(
        talk,
        tuple((it.signs[0], it.signs[-1]) for it in private.kinds),
        tuple(dict.fromkeys(opposed)),
        tuple(it.sign for it in said if thing_at(it.content, "target") == x),
        tuple(_signs_at(SUBJECT, contents)),
        tuple(
            it for it in _signs_at(COMPONENT, contents) if not knows(private.nouns, it)
        ),
        private.nouns,
    )


def _signs_at(
    label: str, contents: Sequence[tuple[Record, Sequence[Record]]]
) -> Iterator[Record]:
    """The signs of which contents have the meanings under a label."""
    for content, signs in contents:
        yield from (it for it in signs if it.meaning == content.get(label))


@lru_cache(256)
def kind_topics(now: KindSituation) -> Sequence[Sayings]:
    """What leads on to kinds, topic by topic."""
    talk = now.talk
    pairs = [*permutations(now.nouns, 2)]
    topics = [
        [*_second_names(now)],
        [it for pair in pairs for it in _classifications(talk, *pair)],
        [it for noun in now.nouns for it in _criteria(talk, noun)],
        [it for pair in now.opposed for it in _classifications(talk, *pair)],
        [it for pair in now.kinds for it in _repetitions(talk, *pair)],
        [it for pair in now.kinds for it in _consequences(talk, *pair)],
        [it for noun in now.subjects for it in _criteria(talk, noun)],
        [_of_this(talk, act, it) for it in now.parts for act in _NAMING],
    ]
    return [topic for topic in topics if topic]


_NAMING = ("instruct", "reject", "correct")
"""The moves that say what a thing is, or is not."""


def _second_names(now: KindSituation) -> Iterator[Saying]:
    """That the thing attended to is, or is not, something else than it was called."""
    others = (it for it in now.talk.words.nouns.values() if not knows(now.named, it))
    for noun in others if now.named else ():
        yield _of_this(now.talk, "reject", noun)
        yield _of_this(now.talk, "instruct", noun)


def _classifications(talk: WorldTalk, lower: Record, upper: Record) -> Iterator[Saying]:
    """That the one is a kind of the other, or the same."""
    yield talk.say("classify", subsumption_matter(lower, upper))
    yield talk.say("equate", synonymy_matter(lower, upper))


def _repetitions(talk: WorldTalk, lower: Record, upper: Record) -> Iterator[Saying]:
    """What may be said of two kinds of which it is known which is one of which."""
    yield talk.say("classify", subsumption_matter(upper, lower))
    for act in ("unclassify", "unclassify", "ask_subkind", "classify"):
        yield talk.say(act, subsumption_matter(lower, upper))


def _consequences(talk: WorldTalk, lower: Record, upper: Record) -> Iterator[Saying]:
    """What may be said of a thing in view that is of a kind, or not."""
    called = Claim(upper, Phrase("", (lower,)), denies=True)
    yield talk.say("reject", called)
    if talk.world.attended_thing is None:
        return
    for act, sign in (
        ("instruct", lower),
        ("instruct", lower),
        ("reject", upper),
        ("reject", upper),
        ("ask_why", upper),
        ("ask_why", upper),
        ("ask_whether", upper),
    ):
        yield _of_this(talk, act, sign)


def _criteria(talk: WorldTalk, noun: Record) -> Iterator[Saying]:
    """By what the things of a noun are known, or not, and whether they are."""
    words = talk.words
    part = next(it for it in reversed(words.nouns.values()) if it != noun)
    for quality in words.colours[:2]:
        for often in ("Generally", "Never"):
            matter = generic_matter(noun, often, quality=quality)
            yield talk.say("generalise", matter)
    yield talk.say("generalise", generic_matter(noun, "Always", part=part))
    for matters in (True, False):
        yield talk.say("weigh_cue", cue_matter(noun, "colour", matters))
    yield talk.say("ask_generic", cue_matter(noun, "colour", True))
    yield talk.say(
        "ask_generic", generic_matter(noun, "Always", quality=words.colours[0])
    )


def _of_this(talk: WorldTalk, act: str, sign: Record) -> Saying:
    """What is said of the thing that is attended to, as a move."""
    return talk.say(act, Claim(sign, THIS, denies=act == "reject"))
