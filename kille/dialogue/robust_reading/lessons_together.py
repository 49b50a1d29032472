"""Lessons that are said in one breath: joined to one move, doubted, and filled in.

"A pen, and this is a pencil." makes two claims; the robot asks about them together.
"The left one is a cup, the right one isn't." leaves out what the second one claims.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from dataclasses import replace

from kille.dialogue.language import Sentence, Utterance
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    is_denial,
    join_claims,
    merge_of,
    predicate_at,
    set_to,
    single_claims,
    value_at,
)
from kille.dialogue.taxonomy import LOWER, UPPER
from kille.dialogue.word_lists import DOUBTFUL, PARTIAL
from ttr import Record, RecordType, RecType

TOGETHER = ("instruct", "describe", "reject")
"""The lessons that are asked about together with others."""

MOST = 3
"""How many lessons are asked about together, at most."""


def doubt_lesson(
    said: Sentence, doubt: str, *, anew: bool = False, types: DialogueTypes
) -> Sentence:
    """The lesson, which is asked about before it is learned.

    A doubt that it has already stays, unless it is to be set anew.
    """
    text = types["Text"] @ doubt
    readings = (
        Utterance(
            it.text,
            it.type if "doubt" in it.type and not anew else set_to(it.type, doubt=text),
        )
        for it in said.readings
    )
    return replace(said, readings=tuple(readings))


def correct_lesson(said: Sentence, *, types: DialogueTypes) -> Sentence:
    """The lesson as a correction, if it says what a thing is, or how."""
    corrects = types.record_type("Correct")["e"]
    readings = (
        Utterance(it.text, set_to(it.type, e=corrects))
        if predicate_at(it.type, "e").name in ("instruct", "describe", "relate")
        else it
        for it in said.readings
    )
    return replace(said, readings=tuple(readings))


def join_lessons(
    asked: Sequence[Sentence],
    qualities: Set[str] = frozenset(),
    *,
    types: DialogueTypes,
) -> tuple[tuple[Sentence, ...], tuple[Sentence, ...]]:
    """The first of the doubted lessons, joined with what others claim; and the rest.

    Left out is what calls a thing by a word for how things are: "not a real one".
    """
    if not asked:
        return (), ()
    first, *others = asked
    forms = {_form(first.readings[0])}
    joined = [
        it
        for it in others
        if _may_be_joined(it)
        and _may_stand_beside(first, it)
        and (it.adds or _says_how(it) or _form(it.readings[0]) not in qualities)
    ]
    joined = joined if _may_be_joined(first) else []
    more: list[Utterance] = []
    rest = [
        it
        for it in others
        if it not in joined
        and not _says_same(it, first)
        and _form(it.readings[0]) not in qualities
    ]
    for it in joined:
        best = it.readings[0]
        new = _form(best) not in forms or "d" not in str(best.content.get("target"))
        if new and len(more) < MOST - 1:
            forms.add(_form(best))
            more.append(_of_same_thing(best, types) if it.adds else best)
        elif new:
            rest.append(it)
    if not more:
        return (first,), tuple(rest)
    text = " ".join(dict.fromkeys((first.text, *(it.text for it in more))))
    readings = tuple(
        Utterance(text, _join(it, more, text, types))
        for it in first.readings
        if _may_be_meant(it)
    )
    return (Sentence(text, readings),), tuple(rest)


def join_descriptions(
    said: Sequence[Sentence], known: Set[str], *, types: DialogueTypes
) -> list[Sentence]:
    """The moves, of which those about one thing that a new word names are one move.

    "This cup is white and small." says of one thing that it is a cup, white and small;
    who does not know cups has to ask about all of it.
    """
    joined: list[Sentence] = []
    for it in said:
        if joined and _describes_with(it, joined[-1], known):
            joined[-1] = _join_readings(joined[-1], it, types)
        else:
            joined.append(it)
    return joined


def _describes_with(said: Sentence, before: Sentence, known: Set[str]) -> bool:
    """Whether two moves say how one thing is, which both call by a new noun."""
    both = [it.readings[0] for it in (before, said) if it.readings]
    if len(both) < 2 or any(
        predicate_at(it.type, "e").name != "describe" or "doubt" in it.type
        for it in both
    ):
        return False
    target = both[0].content.get("target")
    if not isinstance(target, RecordType) or both[1].content.get("target") != target:
        return False
    return any(
        it.kind == "noun" and it.form not in known and claims(target, it)
        for it in both[0].signs
    )


def _join_readings(before: Sentence, said: Sentence, types: DialogueTypes) -> Sentence:
    """The first of two moves, which says what the second one does as well."""
    best = said.readings[0]
    readings = []
    for it in before.readings:
        signs = tuple(dict.fromkeys((*it.signs, *best.signs)))
        content = join_claims(*single_claims(it.content), best.content)
        readings.append(_with_content(it, content, signs, types))
    return replace(before, readings=tuple(readings))


def _of_same_thing(reading: Utterance, types: DialogueTypes) -> Utterance:
    """The claim of what was just spoken of, if of nothing else: "or just a jug"."""
    target = reading.content.get("target")
    if not isinstance(target, RecordType) or "d" in target or "c" in target:
        return reading
    it = set_to(target, d=types.record_type("It")["d"])
    content = set_to(reading.content, target=it)
    return _with_content(reading, content, reading.signs, types)


def _says_same(said: Sentence, other: Sentence) -> bool:
    return _form(said.readings[0]) == _form(other.readings[0])


def _join(
    first: Utterance, others: Iterable[Utterance], text: str, types: DialogueTypes
) -> RecordType:
    """The type of saying several things at once."""
    signs = dict.fromkeys((*first.signs, *(sign for it in others for sign in it.signs)))
    content = join_claims(first.content, *(it.content for it in others))
    return set_to(
        first.type,
        text=types["Text"] @ text,
        signs=types.record_type("Heard")["signs"] @ tuple(signs),
        content=RecType @ content,
        doubt=types["Text"] @ PARTIAL,
    )


def _says_how(said: Sentence) -> bool:
    return "a" in said.readings[0].content


def _form(reading: Utterance) -> str:
    """The word of a lesson, however it is said of its thing."""
    return next((it.form for it in reading.signs if claims(reading.content, it)), "")


def _may_be_joined(said: Sentence) -> bool:
    best = said.readings[0]
    return _may_be_meant(best) and predicate_at(best.type, "e").name in TOGETHER


def _may_stand_beside(first: Sentence, other: Sentence) -> bool:
    """Whether two lessons are asked about alike: doubtful words only of two things."""
    one, two = first.readings[0], other.readings[0]
    is_apart = one.content.get("target") != two.content.get("target")
    return is_apart or (_is_partial(one) and _is_partial(two))


def _may_be_meant(reading: Utterance) -> bool:
    """Whether a lesson may be asked about as it was said, or its word is doubtful."""
    return "doubt" in reading.type and value_at(reading.type, "doubt") in (
        PARTIAL,
        DOUBTFUL,
    )


def _is_partial(reading: Utterance) -> bool:
    return "doubt" in reading.type and value_at(reading.type, "doubt") == PARTIAL


def fill_from(
    said: Sentence, before: Sequence[Sentence], *, types: DialogueTypes
) -> Sentence:
    """An elliptic claim, filled with what the claim before it says, or with its thing.

    "The other one isn't" says of another thing what was just said, "and soft" of the
    same thing something else, and "i.e. a kind of cup" of the kind that was named.
    """
    if said.readings and UPPER in said.readings[0].content:
        return _fill_kind(said, before, types)
    told = next(
        (it.readings[0] for it in reversed(before) if _claims_something(it)), None
    )
    if told is None:
        return Sentence(said.text, ())
    sign = next(it for it in told.signs if claims(told.content, it))
    label = "c" if "c" in told.content else "a"
    readings = []
    for it in said.readings:
        if _claims_something(said):
            same = set_to(it.content, target=told.content["target"])
            signs = tuple(dict.fromkeys((*told.signs, *it.signs)))
            readings.append(_with_content(it, same, signs, types))
            continue
        denies = predicate_at(it.type, "e").name == "reject"
        whole = (
            denial(told.content)
            if denies is not is_denial(told.content)
            else told.content
        )
        about = merge_of(types.record_type("Asked"), it.content)
        content = set_to(about, **{label: whole[label]})
        signs = (*it.signs, sign)
        readings.append(_with_content(it, content, signs, types))
    return replace(said, readings=tuple(readings))


def _fill_kind(
    said: Sentence, before: Sequence[Sentence], types: DialogueTypes
) -> Sentence:
    """What says of which kind another is one, of the kind that was spoken of last."""
    told = next((it.readings[0] for it in reversed(before) if it.readings), None)
    lower = None if told is None else _noun_of(told)
    if lower is None:
        return Sentence(said.text, ())
    readings = []
    for it in said.readings:
        content = set_to(it.content, **{LOWER: lower.meaning})
        readings.append(_with_content(it, content, (lower, *it.signs), types))
    return replace(said, readings=tuple(readings))


def _noun_of(told: Utterance) -> Record | None:
    """The noun that a claim says of a thing, or the kind that it speaks of."""
    content = told.content
    for sign in (it for it in told.signs if it.kind == "noun"):
        if content.get(LOWER) == sign.meaning or claims(content, sign):
            return sign
    return None


def _with_content(
    said: Utterance,
    content: RecordType,
    signs: tuple[Record, ...],
    types: DialogueTypes,
) -> Utterance:
    heard = types.record_type("Heard")
    move = set_to(said.type, signs=heard["signs"] @ signs, content=RecType @ content)
    return Utterance(said.text, move)


def is_about_it(said: Sentence, *, types: DialogueTypes) -> bool:
    """Whether a sentence is about what was just spoken of, called "it"."""
    target = said.readings[0].content.get("target") if said.readings else None
    it = types.record_type("It")["d"]
    return isinstance(target, RecordType) and target.get("d") == it


def _claims_something(said: Sentence) -> bool:
    return bool(said.readings) and bool(
        {"c", "a"} & set(said.readings[0].content.labels)
    )


def are_about_unmarked_things(
    moves: Iterable[Sentence], *, types: DialogueTypes
) -> bool:
    """Whether several lessons in nouns say "this" or "that", or nothing, of a thing."""
    names = [
        it.readings[0].content
        for it in moves
        if it.readings and predicate_at(it.readings[0].type, "e").name == "instruct"
    ]
    return sum(_is_unmarked(it, types) for it in names) > 1


def is_about_unmarked_thing(said: Sentence, *, types: DialogueTypes) -> bool:
    """Whether a sentence says "this", "that" or "it" of a thing, or nothing."""
    if not said.readings:
        return False
    return is_about_it(said, types=types) or _is_unmarked(
        said.readings[0].content, types
    )


def _is_unmarked(content: RecordType, types: DialogueTypes) -> bool:
    target = content.get("target")
    if not isinstance(target, RecordType) or set(target.labels) > {"x", "look", "d"}:
        return False
    shown = [types.record_type(it)["d"] for it in ("This", "That")]
    return "d" not in target or target["d"] in shown
