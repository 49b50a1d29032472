"""By what things of a kind are known: reasons that a tutor has corrected, or given.

A content that says so has a `subject`, what a noun means, and one of three: a `cue` and
whether it `matters`; a `property`, what an adjective means, and how `often` it is true
of such things; or a `component`, what the noun for a part of them means. In all three
the `degree` is a number that the theory sets.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from kille.dialogue.meanings import DialogueTypes, value_at, word_of
from ttr import Record, RecordType, rectype
from ttr.types import Singleton

SUBJECT, CUE, PROPERTY, COMPONENT = "subject", "cue", "property", "component"
"""The labels of what is said of which things."""

CUES = ("colour", "shape", "size", "texture", "pattern", "details")
"""What a cue may be, by the name that the theory has for it."""

MATTERS = ("MattersNot", "Matters")
"""The types that say whether a cue matters."""

OFTEN = (
    "Never",
    "Seldom",
    "Sometimes",
    "Often",
    "Usually",
    "Generally",
    "Always",
)
"""The types that say how often something is so."""


def criterion(
    subject: Record,
    *,
    cue: str = "",
    matters: bool = False,
    quality: Record | None = None,
    part: Record | None = None,
    often: str = "Generally",
    types: DialogueTypes,
) -> RecordType:
    """The content that the things of a noun are known by this, or not.

    >>> from kille.dialogue.meanings import adjective, noun, packaged_types
    >>> types = packaged_types()
    >>> print(criterion(noun("mug"), quality=adjective("white"), types=types))
    [degree = 0.9 : Number, often = generally : Text,
     property : [look : Look, x : Ind, a : is_white(x, look)],
     subject : [look : Look, x : Ind, c : mug(x, look)]]
    """
    said = types.record_type(MATTERS[matters] if cue else often)
    fields = {SUBJECT: subject.meaning, **dict(said.fields)}
    if cue:
        fields[CUE] = types["Text"] @ cue
    if quality is not None:
        fields[PROPERTY] = quality.meaning
    if part is not None:
        fields[COMPONENT] = part.meaning
    return rectype(fields)


def nearest_often(degree: float, *, types: DialogueTypes) -> str:
    """The type that says best how often something is so that has this degree."""
    return min(
        OFTEN,
        key=lambda it: abs(degree_of(types.record_type(it)) - degree),
    )


def degree_of(content: RecordType) -> float:
    """How many of the things are so, or how much a cue counts, from 0 to 1."""
    degree = value_at(content, "degree")
    assert isinstance(degree, float)
    return degree


def learned_act(content: RecordType) -> str:
    """What the robot says when it has learned a criterion."""
    if CUE not in content:
        return "LearnedGeneric"
    return "StressedCue" if degree_of(content) else "IgnoredCue"


HALF = 0.5
"""What is true of more than so many things of a kind speaks for it."""


def is_against(content: RecordType, other: RecordType) -> bool:
    """Whether one content says that things are known by what the other denies.

    >>> from kille.dialogue.meanings import adjective, noun, packaged_types
    >>> types, mug, white = packaged_types(), noun("mug"), adjective("white")
    >>> usually, often, never = (
    ...     criterion(mug, quality=white, often=it, types=types)
    ...     for it in ("Usually", "Often", "Never")
    ... )
    >>> is_against(never, usually), is_against(often, usually)
    (True, False)
    """
    return is_about_same(content, other) and (degree_of(content) > HALF) != (
        degree_of(other) > HALF
    )


def what_of(content: RecordType) -> tuple[str, object]:
    """Of what a content says that things are known by it, or not: its label, and it."""
    label = next(it for it in (CUE, PROPERTY, COMPONENT) if it in content)
    return label, content[label]


def is_about_same(one: RecordType, other: RecordType) -> bool:
    """Whether two contents speak of the same for the same noun, whatever they say."""
    return one.get(SUBJECT) == other.get(SUBJECT) and what_of(one) == what_of(other)


def criteria_about(s: Record, content: RecordType) -> list[Record]:
    """What was said of the same for the same noun."""
    return [it for it in s.private.criteria if is_about_same(it.content, content)]


def criteria_of(s: Record, noun: Record) -> Iterator[Record]:
    """By what the things of a noun were said to be known, the latest last."""
    own = word_of(noun)
    for it in s.private.criteria:
        if word_of(it.signs[0]) is own:
            yield it


def last_subject(s: Record) -> RecordType | None:
    """What the noun means of which the robot has just said by what things are known."""
    for move in s.private.last[::-1]:
        told = move["content"]
        said = told.value if isinstance(told, Singleton) else None
        subject = said.get(SUBJECT) if isinstance(said, RecordType) else None
        if isinstance(subject, RecordType):
            return subject
    return None


def sign_at(content: RecordType, label: str, signs: Iterable[Record]) -> Record | None:
    """The word whose meaning a content has under a label."""
    return next((it for it in signs if it.meaning == content.get(label)), None)


def signs_in(content: RecordType, signs: Sequence[Record]) -> list[Record]:
    """The words of a content: the subject, and the quality or the part."""
    found = (sign_at(content, it, signs) for it in (SUBJECT, PROPERTY, COMPONENT))
    return [it for it in found if it is not None]
