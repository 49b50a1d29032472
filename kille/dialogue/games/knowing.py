"""What do you know? What is a cup? The robot tells of the words that it has learned."""

from __future__ import annotations

from kille.dialogue.games.citing import cite_all, tell_kinds
from kille.dialogue.language import TAUGHT
from kille.dialogue.meanings import DialogueTypes, word_of
from kille.dialogue.moves import plan
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from kille.dialogue.unknown_words import plan_unknown_word
from ttr import Model, Record
from ttr.updates import first

TOLD = {
    "nouns": "TellNouns",
    "adjectives": "TellAdjectives",
    "relations": "TellRelations",
}
"""What the robot says of all words of a kind, by the place where they are known."""

MEANT = {"noun": "MeanNoun", "adjective": "MeanAdjective", "relation": "MeanRelation"}
"""What it says of what one word means, by the word's kind."""


@rule(answers="AskKnowledge")
def tell_words(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks what it knows: it lists its words, kind by kind.

    Asked what it was taught, it leaves out what it knows without a lesson.
    """
    state, said = s, s.shared.latest
    only_taught = "stance" in said and said.stance == TAUGHT
    lessons = [word_of(it.sign) for it in (*s.private.lessons, *s.private.taught)]
    for kind, act in TOLD.items():
        known = [
            it
            for it in s.private[kind]
            if not (only_taught and lessons) or word_of(it) in lessons
        ]
        if known:
            claims = s.shared.pending
            state = plan(
                state, act, signs=known, recalls=known, pending=claims, types=types
            )
    return None if state is s else state


@rule(answers="AskKnowledge")
def know_nothing(s: Record, *, types: DialogueTypes) -> Record:
    """It has learned no word yet."""
    return plan(s, "KnowNothing", types=types)


@rule(answers="AskMeaning")
def tell_meaning(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks what a word means: of what it learned it, and what it was told."""
    known = {word_of(sign): sign for sign in words(s)}
    for said in s.shared.latest.signs:
        sign = known.get(word_of(said))
        if sign is not None:
            act, claims = MEANT[sign.kind], s.shared.pending
            meaning = sign.meaning
            told = plan(
                s,
                act,
                meaning,
                signs=[sign, *s.private.adjectives],
                recalls=[sign],
                pending=claims,
                types=types,
            )
            return tell_kinds(cite_all(told, sign, types=types), sign, types=types)
    return None


@rule(answers=("AskMeaning", "AskTaught", "AskLessons"))
def miss_meaning(s: Record, *, types: DialogueTypes) -> Record:
    """The word was never learned."""
    if not s.shared.latest.signs:
        return plan(s, "KnowNothing", types=types)
    sign = s.shared.latest.signs[0]
    return plan_unknown_word(s, sign, pending=s.shared.pending, types=types)


@rule(answers=("AskTaught", "AskLessons"))
def tell_taught(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor asks if or when a word was taught: it recalls the latest lesson.

    Asked how often, it says that.

    Of no word in particular, it is the word of the latest lesson of this dialogue.
    """
    how_often = types.has(s.shared.latest, "AskLessons", model)
    known = {word_of(sign): sign for sign in words(s)}
    said = s.shared.latest.signs or [it.sign for it in s.private.lessons[-1:]]
    for sign in said:
        if word_of(sign) not in known:
            continue
        sign, claims = known[word_of(sign)], s.shared.pending
        return plan(
            s,
            "TellLessons" if how_often else "TellTaught",
            sign.meaning,
            signs=[sign],
            recalls=[sign],
            pending=claims,
            types=types,
        )
    return None


KNOWING = first(tell_words, know_nothing, tell_meaning, tell_taught, miss_meaning)
