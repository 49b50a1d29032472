"""The content of a memory: words, turns and lessons, as immutable values."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Iterator
from dataclasses import astuple, dataclass, field, replace
from typing import Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from kille.memory.pictures import Picture
from kille.scene import Configuration, Point, Traits, Vector

Kind = Literal["object", "attribute", "relation", "subkind", "criterion"]
"""What a word describes: what a thing is, how it is, or where it is.

A lesson of the kind "subkind" says what the kind of thing that it names is a kind of,
one of the kind "criterion" by what things of that kind are known.

>>> from typing import get_args
>>> from kille.memory import Kind
>>> get_args(Kind)
('object', 'attribute', 'relation', 'subkind', 'criterion')
"""

By = Literal["cue", "quality", "part"]
"""By what a kind of thing is known: a cue, how the things are, or what parts they have.
"""

DESCRIPTOR_LENGTH = 128

LONGEST_WORD = 1000
"""The most characters of a word; no sentence that teaches one is so long."""

# Control characters, halves of characters, and other line breaks. Of the invisible
# characters only those that turn the direction of writing.
_STEERING = frozenset({"Cc", "Cs", "Zl", "Zp"})
_TURNING = frozenset({"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"})


@dataclass(frozen=True)
class Word:
    """A word that was learned.

    `name` is what its predicate is called (`can_of_paint`), `surface` what the tutor
    said when it was first taught ("can of paint"), `article` what stood before it then,
    "" where that is unknown. Raises ValueError for a name that is empty or longer than
    LONGEST_WORD, and for characters that no word has: those that steer a terminal.

    >>> tin = Word("can_of_paint", "can of paint", "object", article="a")
    >>> tin.surface
    'can of paint'
    """

    name: str
    surface: str
    kind: Kind
    article: str = ""

    def __post_init__(self) -> None:
        _require_word("the name of a word", self.name)
        for what, text in (("a word", self.surface), ("an article", self.article)):
            _require_letters(what, text)


@dataclass(frozen=True)
class Dialogue:
    """The fact that a dialogue began, at a time in ISO 8601.

    >>> Dialogue(1, "2026-01-31T12:00:00").began
    '2026-01-31T12:00:00'
    """

    number: int
    began: str


@dataclass(frozen=True)
class Turn:
    """Something said: the `number`-th turn of a dialogue.

    `judgement` is what it was understood to be, in the notation of TTR; `time` is the
    wall clock's, as ISO 8601 text.

    >>> turn = Turn(1, 1, "tutor", "This is a cup.", "", "2026-01-31T12:00:00")
    >>> turn.speaker, turn.text
    ('tutor', 'This is a cup.')
    """

    dialogue: int
    number: int
    speaker: str
    text: str
    judgement: str
    time: str


@dataclass(frozen=True, eq=False)
class Scan:
    """The features of one scan of an object.

    descriptors (n, 128) uint8; points (n, 3) float32 in metres, NaN where there was
    no depth. Raises ValueError for arrays of another shape or type, which would not
    come back as they were.

    >>> scan = Scan(np.zeros((2, 128), np.uint8), np.zeros((2, 3), np.float32))
    >>> len(scan.descriptors)
    2
    """

    descriptors: NDArray[np.uint8]
    points: NDArray[np.float32]

    def __post_init__(self) -> None:
        n = len(self.descriptors)
        _require("descriptors", self.descriptors, "uint8", (n, DESCRIPTOR_LENGTH))
        _require("points", self.points, "float32", (n, 3))


class CheckedTraits(dict[str, Vector]):
    """Traits whose vectors are known to be flat, float32 and finite.

    Thousands of vectors are checked together in less time than one by one.
    """


@dataclass(frozen=True, eq=False)
class Sighting:
    """An object as it was seen when its word was taught.

    `time` is that of the first frame, in seconds of the sensor's clock; `place` is in
    metres, None where the sensor has no depth. `traits` are those of the object as a
    whole, vectors (k,) float32 by the name of the cue. Raises ValueError for numbers
    that are not finite and for vectors of another shape or type.

    >>> size = np.array([0.1, 0.2, 0.3], np.float32)
    >>> Sighting("kinect", 12.5, (), None, {"size": size}).traits["size"].shape
    (3,)
    """

    sensor: str
    time: float
    scans: tuple[Scan, ...]
    place: Point | None
    traits: Traits = field(default_factory=dict)
    picture: Picture | None = None

    def __post_init__(self) -> None:
        _require_finite("a sighting", self.time, *(self.place or ()))
        check_traits(self.traits)


@dataclass(frozen=True)
class Arrangement:
    """Two objects as they were placed when the word for their relation was taught.

    `target` and `landmark` are names of words, or empty for a thing that has none;
    `configuration` says how the target stands to the landmark. Raises ValueError for
    numbers that are not finite and for names that are none.

    >>> from kille.scene import Configuration
    >>> behind = Arrangement("kinect", 12.5, "cup", "book", Configuration((0, 0.2, 0)))
    >>> behind.configuration.offset
    (0, 0.2, 0)
    """

    sensor: str
    time: float
    target: str
    landmark: str
    configuration: Configuration
    picture: Picture | None = None

    def __post_init__(self) -> None:
        numbers = _numbers(astuple(self.configuration))
        _require_finite("an arrangement", self.time, *numbers)
        for what, name in (("target", self.target), ("landmark", self.landmark)):
            if name != "":
                _require_word(f"a {what}", name)


@dataclass(frozen=True)
class Subsumption:
    """What a kind of thing was said to be a kind of: the `upper` word.

    It was only said, so that there is neither a sensor nor a picture.

    >>> Subsumption(Word("vessel", "vessel", "object", "a")).upper.name
    'vessel'
    """

    upper: Word
    sensor: str = ""
    time: float = 0.0
    picture: Picture | None = None

    def __post_init__(self) -> None:
        _require_finite("a subsumption", self.time)


@dataclass(frozen=True)
class Criterion:
    """By what things of a kind were said to be known, or not.

    For a quality or a part, named as a `Word` is, `degree` is how many of the things
    are so, or have it, from 0 to 1. For a cue it is how much this counts: 0 where it
    does not matter, 1 where it is what matters. It was only said, so that there is
    neither a sensor nor a picture. Raises ValueError for another degree or name.

    >>> Criterion("quality", "red", "red", 0.9).degree
    0.9
    """

    by: By
    name: str
    surface: str
    degree: float
    article: str = ""
    sensor: str = ""
    time: float = 0.0
    picture: Picture | None = None

    def __post_init__(self) -> None:
        _require_word("the name of a criterion", self.name)
        for what, text in (("a word", self.surface), ("an article", self.article)):
            _require_letters(what, text)
        if self.by not in get_args(By):
            raise ValueError(f"a criterion is by one of {get_args(By)}, not {self.by}")
        _require_finite("a criterion", self.time, self.degree)
        if not 0.0 <= self.degree <= 1.0:
            raise ValueError(f"a degree is from 0 to 1, not {self.degree}")


@dataclass(frozen=True)
class Lesson:
    """The fact that a turn taught a word; `key` identifies the lesson for good.

    It `holds`, or it is one in what the word does not hold of: "this is not a cup".

    >>> cup = Word("cup", "cup", "object", "a")
    >>> turn = Turn(1, 1, "tutor", "This is a cup.", "", "2026-01-31T12:00:00")
    >>> Lesson(7, cup, turn, holds=False).word.name
    'cup'
    """

    key: int
    word: Word
    turn: Turn
    holds: bool = field(default=True, kw_only=True)


@dataclass(frozen=True, eq=False)
class ObjectLesson(Lesson):
    """A lesson in a name or an attribute of an object, with what was seen.

    >>> cup = Word("cup", "cup", "object", "a")
    >>> turn = Turn(1, 1, "tutor", "This is a cup.", "", "2026-01-31T12:00:00")
    >>> ObjectLesson(7, cup, turn, Sighting("kinect", 12.5, (), None)).seen.sensor
    'kinect'
    """

    seen: Sighting


@dataclass(frozen=True)
class RelationLesson(Lesson):
    """A lesson in a spatial relation, with what was seen.

    >>> from kille.scene import Configuration
    >>> turn = Turn(1, 1, "tutor", "It is behind it.", "", "2026-01-31T12:00:00")
    >>> word, placed = Word("behind", "behind", "relation"), Configuration((0, 0.2, 0))
    >>> seen = Arrangement("kinect", 12.5, "cup", "book", placed)
    >>> RelationLesson(7, word, turn, seen).seen.landmark
    'book'
    """

    seen: Arrangement


@dataclass(frozen=True)
class KindLesson(Lesson):
    """A lesson that one kind of thing is a kind of another: an axiom.

    >>> cup, vessel = (Word(it, it, "subkind", "a") for it in ("cup", "vessel"))
    >>> turn = Turn(1, 1, "tutor", "A cup is a vessel.", "", "2026-01-31T12:00:00")
    >>> KindLesson(7, cup, turn, Subsumption(vessel)).seen.upper.name
    'vessel'
    """

    seen: Subsumption


@dataclass(frozen=True)
class CriterionLesson(Lesson):
    """A lesson by what things of a kind are known.

    >>> turn = Turn(1, 1, "tutor", "Cups have handles.", "", "2026-01-31T12:00:00")
    >>> handles = Criterion("part", "handle", "handle", 1.0, "a")
    >>> CriterionLesson(7, Word("cup", "cup", "criterion", "a"), turn, handles).seen.by
    'part'
    """

    seen: Criterion


SeenLesson: TypeAlias = ObjectLesson | RelationLesson | KindLesson | CriterionLesson
"""A lesson with what it was taught by."""

Seen: TypeAlias = Sighting | Arrangement | Subsumption | Criterion
"""What a lesson was taught by."""


def lesson_of(
    key: int, word: Word, turn: Turn, seen: Seen, *, holds: bool
) -> SeenLesson:
    """A lesson of the kind that fits what was seen."""
    match seen:
        case Sighting():
            return ObjectLesson(key, word, turn, seen, holds=holds)
        case Arrangement():
            return RelationLesson(key, word, turn, seen, holds=holds)
        case Subsumption():
            return KindLesson(key, word, turn, seen, holds=holds)
    return CriterionLesson(key, word, turn, seen, holds=holds)


def with_picture(lesson: SeenLesson, picture: Picture | None) -> SeenLesson:
    """A copy of the lesson with this picture of what was seen."""
    match lesson:
        case ObjectLesson():
            return replace(lesson, seen=replace(lesson.seen, picture=picture))
        case RelationLesson():
            return replace(lesson, seen=replace(lesson.seen, picture=picture))
        case KindLesson() | CriterionLesson():
            return lesson


def has_same_content(one: SeenLesson, other: SeenLesson) -> bool:
    """Do two lessons teach the same from the same turn and the same evidence?

    Their keys do not count; NaN is the same as NaN.
    """
    if (one.word, one.turn, one.holds) != (other.word, other.turn, other.holds):
        return False
    if not isinstance(one.seen, Sighting) or not isinstance(other.seen, Sighting):
        return one.seen == other.seen
    return _facts(one.seen) == _facts(other.seen) and all(
        np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
        for a, b in zip(_arrays(one.seen), _arrays(other.seen), strict=True)
    )


def _facts(seen: Sighting) -> tuple[object, ...]:
    """All fields of a sighting except its arrays."""
    cues = sorted(seen.traits)
    return seen.sensor, seen.time, len(seen.scans), seen.place, cues, seen.picture


def _arrays(seen: Sighting) -> Iterator[NDArray[np.generic]]:
    """The arrays of a sighting in a fixed order."""
    for scan in seen.scans:
        yield scan.descriptors
        yield scan.points
    yield from (seen.traits[cue] for cue in sorted(seen.traits))


def _require_word(what: str, text: str) -> None:
    _require_letters(what, text)
    if not 0 < len(text) <= LONGEST_WORD:
        raise ValueError(f"{what} has 1 to {LONGEST_WORD} characters, not {len(text)}")


def _require_letters(what: str, text: str) -> None:
    if not isinstance(text, str):
        raise TypeError(f"{what} is text, not {text!r}")
    if text.isprintable():
        return
    for letter in text:
        steers = unicodedata.category(letter) in _STEERING
        if steers or unicodedata.bidirectional(letter) in _TURNING:
            raise ValueError(f"{what} cannot have the character {letter!a}")


def _require(
    name: str, array: NDArray[np.generic], dtype: str, shape: tuple[int, ...]
) -> None:
    if array.dtype != np.dtype(dtype) or array.shape != shape:
        raise ValueError(
            f"{name} must be {dtype} {shape}, not {array.dtype} {array.shape}"
        )


def check_traits(traits: Traits) -> None:
    """Check that each vector is flat, float32 and finite. Raises ValueError."""
    if isinstance(traits, CheckedTraits):
        return
    for cue, vector in traits.items():
        _require_trait(cue, vector)


def _require_trait(cue: str, vector: Vector) -> None:
    name = f"the trait {cue}"
    _require(name, vector, "float32", (vector.size,))
    if not np.isfinite(vector).all():
        raise ValueError(f"{name} needs finite numbers, not {vector}")


def _require_finite(owner: str, *numbers: float) -> None:
    if not all(map(math.isfinite, numbers)):
        raise ValueError(f"{owner} needs finite numbers, not {numbers}")


def _numbers(value: object) -> Iterator[float]:
    """All numbers in nested tuples."""
    match value:
        case tuple():
            for part in value:
                yield from _numbers(part)
        case int() | float():
            yield value
