"""What a text says and takes back: "It's a mug, and it's also not a mug.".

Nothing is learned of what is both claimed and denied in one sentence. Who wavers, "This
is a cup. No, it isn't. Yes, it is.", is asked what is meant; and who says the same word
with another article corrects the article, not the word.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.language import Sentence, Utterance
from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    claims,
    denial,
    is_denial,
    predicate_at,
    value_at,
)
from kille.dialogue.robust_reading.lessons_together import doubt_lesson
from kille.dialogue.word_lists import CONTRADICTORY, PARTIAL, SAYING
from ttr import RecordType

ANSWERS = frozenset({"affirm", "deny"})
"""What is about something that was said before."""

SAYING_SO = frozenset({"instruct", "describe", "reject", "correct"})
"""The moves that say of one thing what it is, or how, or is not."""


def settle_contradictions(
    said: Sequence[Sentence], things: int = 1, *, types: DialogueTypes
) -> list[Sentence]:
    """The moves of a text, where what contradicts itself is one that is doubted.

    Of two sentences the latter holds. Where several things are in view, "this" may be
    another one the second time.

    >>> from dataclasses import replace
    >>> from kille.dialogue.language import understand
    >>> from kille.dialogue.meanings import packaged_types
    >>> types = packaged_types()
    >>> [one] = understand("It is a mug.")
    >>> [other] = understand("It is not a mug.")
    >>> both = [one, replace(other, text=one.text)]  # in one sentence
    >>> [one] = settle_contradictions(both, types=types)
    >>> one.readings[0].type["doubt"].value
    'contradictory'
    >>> moves = understand("It is a mug. No, it isn't. Yes, it is.")
    >>> [one] = settle_contradictions(moves, types=types)
    >>> one.readings[0].type["doubt"].value
    'partial'
    """
    left = list(said)
    for n, first in enumerate(said):
        for other in said[n + 1 :]:
            if first in left and other in left and _contradict(first, other, things):
                if _differ_in_article(first, other):
                    left.remove(other)
                elif first.text == other.text:
                    left.remove(other)
                    at = left.index(first)
                    left[at] = doubt_lesson(
                        first, CONTRADICTORY, anew=True, types=types
                    )
    return _settle_wavering(left, types)


def _settle_wavering(said: list[Sentence], types: DialogueTypes) -> list[Sentence]:
    """The moves without a no and a yes after a lesson, which is then asked about."""
    acts = [_act(it) for it in said]
    lessons = [n for n, act in enumerate(acts) if act in SAYING_SO]
    if not lessons:
        return said
    after = acts[lessons[-1] + 1 :]
    if (
        len(after) < len(ANSWERS)
        or not ANSWERS.issuperset(after)
        or "deny" not in after
    ):
        return said
    lesson = said[lessons[-1]]
    if after[-1] == "deny" or "affirm" not in after:
        return said
    doubted = doubt_lesson(lesson, PARTIAL, types=types)
    return [*said[: lessons[-1]], doubted]


def _act(it: Sentence) -> str:
    return str(predicate_at(it.readings[0].type, "e").name) if it.readings else ""


def _contradict(one: Sentence, other: Sentence, things: int) -> bool:
    """Whether one of two moves denies what the other one claims of the same thing."""
    if not {_act(one), _act(other)} <= SAYING_SO or any(map(_is_saying, (one, other))):
        return False
    first, second = _claim(one.readings[0]), _claim(other.readings[0])
    if first is None or second is None or is_denial(first) is is_denial(second):
        return False
    denied = denial(first)
    same = all(denied.get(it) == second.get(it) for it in CLAIMS)
    return same and _are_alike(first.get("target"), second.get("target"), things)


def _is_saying(it: Sentence) -> bool:
    """Whether a move is no claim: "It isn't a bottle because it's green."."""
    best = it.readings[0].type
    return "doubt" in best and value_at(best, "doubt") == SAYING


def _claim(it: Utterance) -> RecordType | None:
    """What a move says of a thing, if it says a word of it."""
    content = it.content
    return content if {"c", "a"} & set(content.labels) else None


def _are_alike(one: object, other: object, things: int) -> bool:
    """Whether two phrases speak of one thing, as far as they say: "this", "it"."""
    if not isinstance(one, RecordType) or not isinstance(other, RecordType):
        return True
    pronouns = {"x", "look", "d"}
    bare = set(one.labels) <= pronouns and set(other.labels) <= pronouns
    words = {str(it.get("d")).split("(")[0] for it in (one, other)}
    if things > 1 and words == {"shown"}:
        return False
    return one == other or (bare and words <= _SAME_THING)


_SAME_THING = {"None", "shown", "mentioned"}
"""The words for one thing that was just shown or spoken of."""


def _differ_in_article(one: Sentence, other: Sentence) -> bool:
    """Whether the same noun is said with two articles: "ett äpple, inte en äpple"."""
    first, second = (
        [sign for sign in it.readings[0].signs if claims(it.readings[0].content, sign)]
        for it in (one, other)
    )
    articles = {it.article for it in (*first, *second) if it.article}
    return len(articles) > 1
