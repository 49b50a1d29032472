"""What leads on to kinds: which is a kind of which, by what they are known, and parts.

What speaks against an axiom has to be taught of one thing first; what follows from it,
and what contradicts it, can be said only when it is known.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import permutations, product
from typing import NamedTuple

from kille.dialogue.beliefs import knows
from kille.dialogue.criteria import COMPONENT, SUBJECT, sign_at
from kille.dialogue.meanings import is_denial
from kille.dialogue.reference import thing_at
from kille.lab.worlds.perception import thing
from kille.lab.worlds.sayings import (
    THIS,
    Claim,
    Matter,
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
    that is attended to, `denied` what was said that it is not, `subjects` of what was
    said by what it is known, `parts` are nouns for parts only, `nouns` those that are
    known, `told` those that were said of things here. `recalls` says that some were
    taught on another day.
    """

    talk: WorldTalk
    kinds: tuple[Pair, ...]
    opposed: tuple[Pair, ...]
    named: tuple[Record, ...]
    denied: tuple[Record, ...]
    subjects: tuple[Record, ...]
    parts: tuple[Record, ...]
    nouns: tuple[Record, ...]
    told: tuple[Record, ...]
    recalls: bool


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
    return KindSituation(
        talk,
        tuple((it.signs[0], it.signs[-1]) for it in private.kinds),
        tuple(dict.fromkeys(opposed)),
        _signs_about(said, x),
        _signs_about(denied, x),
        tuple(_signs_at(SUBJECT, private.criteria)),
        tuple(
            it
            for it in _signs_at(COMPONENT, private.criteria)
            if not knows(private.nouns, it)
        ),
        private.nouns,
        tuple(dict.fromkeys(it.sign for it in said)),
        bool(private.taught),
    )


def _signs_about(lessons: Iterable[Record], x: str | None) -> tuple[Record, ...]:
    """The words of the lessons that are about a thing."""
    return tuple(it.sign for it in lessons if thing_at(it.content, "target") == x)


def _signs_at(label: str, criteria: Iterable[Record]) -> Iterator[Record]:
    """The words whose meanings criteria have under a label."""
    for criterion in criteria:
        found = sign_at(criterion.content, label, criterion.signs)
        yield from [] if found is None else [found]


@lru_cache(256)
def kind_topics(now: KindSituation) -> Sequence[Sayings]:
    """What leads on to kinds at any time, topic by topic."""
    pairs = [*permutations(now.nouns, 2)]
    topics = [
        [it for pair in pairs for it in _classifications(now.talk, *pair)],
        [it for noun in now.nouns for it in _criteria(now.talk, noun)],
    ]
    return [topic for topic in topics if topic]


@lru_cache(256)
def topics_about_known_kinds(now: KindSituation) -> Sequence[Sayings]:
    """What follows from what is known of kinds and of things, or contradicts it."""
    talk = now.talk
    topics = [
        [*_second_names(now)],
        [*_clashes(now)],
        [it for noun in now.told for it in _lessons_about_all(talk, noun)],
        talk.sayings("swap") if len(now.told) > 1 else (),
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
    for noun in others if now.named or now.recalls else ():
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


def _lessons_about_all(talk: WorldTalk, noun: Record) -> Iterator[Saying]:
    """That all things here are what one of them was called, or only this one is."""
    yield talk.say("instruct_every", Matter("", (("counted", noun),)))
    if talk.world.attended_thing is not None:
        yield _of_this(talk, "instruct_only", noun)


def _clashes(now: KindSituation) -> Iterator[Saying]:
    """That the thing attended to is of a kind, and not of what that is a kind of."""
    for lower, upper in now.kinds if now.talk.world.attended_thing else ():
        if not knows(now.named, lower):
            yield _of_this(now.talk, "instruct", lower)
        if not knows(now.denied, upper):
            yield _of_this(now.talk, "reject", upper)


def _consequences(talk: WorldTalk, lower: Record, upper: Record) -> Iterator[Saying]:
    """What may be asked, and denied, of things that are of one kind, and so another."""
    called = Claim(upper, Phrase("", (lower,)), denies=True)
    yield talk.say("reject", called)
    if talk.world.attended_thing is not None:
        for act in ("ask_why", "ask_whether"):
            yield _of_this(talk, act, upper)


def _criteria(talk: WorldTalk, noun: Record) -> Iterator[Saying]:
    """By what the things of a noun are known, or not, and whether they are."""
    words = talk.words
    part = next(it for it in reversed([*words.nouns.values()]) if it != noun)
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
