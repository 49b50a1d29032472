"""What is said by a word that was never learned, where it can mean one thing only.

"The ball is between the cup and the book." says of the one thing there that has no name
yet that it is a ball, to who has learned the other two words. The robot asks whether it
is, and learns that from a yes, with what was said of it. So it asks of what the tutor
supposes in such a word: "I think this is a key?".

Source: Lewis 1979, for accommodation; Markman and Wachtel 1988, for the new word that
is taken for the thing without a name.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kille.dialogue.beliefs import is_sure, knows_word, names_of
from kille.dialogue.commitments import kind_of
from kille.dialogue.games.distinguishing import say_where
from kille.dialogue.games.doubting_words import MEANT, MEANT_TOO, PRESUMED
from kille.dialogue.games.placing import AMID
from kille.dialogue.language import UNLIKELY
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    is_denial,
    set_to,
    single_claims,
    word_of,
)
from kille.dialogue.moves import content_of, issue, plan, said_of
from kille.dialogue.reference import (
    PARTS,
    PhraseJudge,
    fits_well,
    intended_readings,
    phrase_at,
    phrases,
    possible_readings,
)
from kille.dialogue.reference.resolving import taught_words
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, rectype, replace
from ttr.updates import first

PRESUPPOSING = ("Relate", "Describe")
"""The lessons that presuppose that there is what they call their things."""


@rule(answers="Heard")
def ask_presupposed(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """A thing is called by a new noun, and only one thing is left that has no name."""
    said = s.shared.latest
    is_lesson = any(types.has(said, it, model) for it in PRESUPPOSING)
    if not is_lesson and not types.has(said, "Asserted", model):
        return None
    found = [*_new_nouns(s)]
    if len(found) != 1:
        return None
    [(label, noun)] = found
    left = _things_left(s, model, label, noun, types=types)
    if len(left) != 1:
        return None
    naming = said_of(s, noun, left[0], types=types)
    besides = [
        it
        for content in single_claims(content_of(s))
        for it in _meant_besides(s, model, content, label, left[0], types=types)
    ]
    return _plan_question(s, model, [naming, *besides], types=types)


def _meant_besides(
    s: Record,
    model: Model,
    content: RecordType,
    label: str,
    x: str,
    *,
    types: DialogueTypes,
) -> list[RecordType]:
    """What is said of a thing besides its name, if it is plain of which things."""
    told = _with_thing(s, content, label, x, types=types)
    if told is None or not phrases(told):
        return [] if told is None else [told]
    found = possible_readings(s, model, told, types=types)
    meant = intended_readings(s, found, types=types)
    return [meant[0].content] if len(meant) == 1 else []


def _new_nouns(s: Record) -> Iterator[tuple[str, Record]]:
    """The phrases that call their things by a new noun, by their labels."""
    said = s.shared.latest
    for label in phrases(said.content):
        phrase = phrase_at(said.content, label)
        for sign in said.signs:
            is_new = sign.kind == "noun" and not knows_word(s, sign)
            if is_new and claims(phrase, sign):
                yield label, sign


def _things_left(
    s: Record, model: Model, label: str, noun: Record, *, types: DialogueTypes
) -> Sequence[str]:
    """The things without a name that a phrase may mean, but for its new noun."""
    content, judge = content_of(s), PhraseJudge(s, model, types=types)
    phrase = phrase_at(content, label)
    own = rectype({it: T for it, T in phrase.fields if it != "c"})
    others = [phrase_at(content, it) for it in PARTS if it in content and it != label]
    taken: set[str] = set()
    for other in others:
        meant = fits_well(s, judge.fits(other))
        meant = [x for x in meant if _was_named(s, x)] or meant
        if len(meant) != 1:
            return ()
        taken.update(meant)
    left = fits_well(s, judge.fits(own))
    if AMID in content:
        amid = phrase_at(content, AMID)
        flanks = rectype({it: T for it, T in amid.fields if it != "b"})
        likely = s.private.strategy.bands.likely
        fits = judge.fits(flanks, left)
        left = [x for x in left if x in fits and fits[x].weakest >= likely]
    return [x for x in left if x not in taken and not _has_name(s, model, x)]


def _has_name(s: Record, model: Model, x: str) -> bool:
    """Whether the robot was told what a thing is, or is sure of it."""
    compares = len(s.private.nouns) > 1
    return _was_named(s, x) or (compares and is_sure(s, names_of(s, model, x)))


def _was_named(s: Record, x: str) -> bool:
    """Whether the tutor has said what a thing is, since it came."""
    told = taught_words(s)
    return any(told.get((word_of(it), x)) for it in s.private.nouns)


def _with_thing(
    s: Record, content: RecordType, label: str, x: str, *, types: DialogueTypes
) -> RecordType | None:
    """What is said about a thing; None if it is no lesson, and not where it is."""
    between = AMID in content and label == "target"
    if not between and (kind_of(content) is None or "scale" in content):
        return None
    look = types["Look"] @ s.view.look
    called = phrase_at(content, label)
    phrase = types.record_type("Phrase") if label == "target" else called
    phrase = set_to(phrase, x=types["Ind"] @ x)
    return set_to(content, look=look, **{label: set_to(phrase, look=look)})


@rule(answers=("Supposed", "Unlikely"))
def ask_supposed(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor supposes something in a word that was never learned: is it (not) so?"""
    said, content = s.shared.latest, content_of(s)
    if kind_of(content) is None or phrases(content) or is_denial(content):
        return None
    asked = next((it for it in said.signs if claims(content, it)), None)
    if asked is None or knows_word(s, asked) or "scale" in content:
        return None
    meant = denial(content) if said.stance == UNLIKELY else content
    return _plan_question(s, model, [meant], types=types)


def _plan_question(
    s: Record, model: Model, told: Sequence[RecordType], *, types: DialogueTypes
) -> Record:
    """The plan to ask whether all of this is so."""
    said, asked = s.shared.latest, s
    options = [replace(said, content=it) for it in told]
    for n, content in enumerate(told):
        where = say_where(s, model, content, types=types)
        asked = plan(
            asked,
            MEANT_TOO if n else MEANT,
            set_to(content, **where),
            signs=said.signs,
            asks=() if n else [issue(PRESUMED, options)],
            types=types,
        )
    return asked


PRESUPPOSED = first(ask_presupposed)
"""What answers a new noun for a thing that is spoken of."""

SUPPOSING = first(ask_supposed)
"""What answers a claim in a new word that is said as a question."""
