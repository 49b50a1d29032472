"""What the robot has learned: lessons kept for good, and learners made of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np

from kille.dialogue.meanings import predicate_name
from kille.grounding.generics import Generic, Generics
from kille.grounding.hindsight import PastLesson, was_right
from kille.grounding.reasons import Reasons, Share, best_rival, shares_of
from kille.grounding.told_answers import find_familiarity
from kille.memory import (
    Arrangement,
    CriterionLesson,
    Kind,
    KindLesson,
    Lesson,
    Memory,
    ObjectLesson,
    Picture,
    RelationLesson,
    Scan,
    Sighting,
    Turn,
    Word,
)
from kille.memory.errors import MemoryClosedError
from kille.memory.late_reading import LateReader
from kille.memory.lessons import By
from kille.perception.attributes import AttributeMemory
from kille.perception.colours import ColourMemory, Palette, colours_of, xkcd
from kille.perception.colours.palette import pack_palette, unpack_palette
from kille.perception.cues import CUES, measure_cues
from kille.perception.descriptor_index import Background, View
from kille.perception.descriptor_index.views import (
    Descriptors,
    GoneError,
    LateView,
)
from kille.perception.evidence import Evidence as Heard
from kille.perception.features import NONE
from kille.perception.learners import Key
from kille.perception.objects import ObjectMemory, kept_features
from kille.perception.relations import RelationMemory
from kille.perception.thumbnails import evidence_of, restore_crop
from kille.scene import Configuration, Percept, Region, Traits

SAID_OF_THINGS = "is_"
"""The prefix of the predicates of adjectives."""

PALETTE = "palette"
"""The trait in which the colours of a thing are kept, as they were in its light."""

_CUE_LENGTHS = {name: cue.length for name, cue in CUES.items()}

Named = tuple[str, Percept]
"""A thing and the name of its word."""


@dataclass(frozen=True)
class LessonSource:
    """Where a lesson comes from: what was said, seen through which sensor, and when."""

    turn: Turn
    sensor: str
    time: float


def _index_in_background(views: Iterable[View]) -> ObjectMemory:
    """An object memory whose index is built in the background."""
    return ObjectMemory(views, builder=Background())


@dataclass(frozen=True)
class Learners:
    """Functions that make the learners of nouns, from views, and of relations."""

    objects: Callable[[Iterable[View]], ObjectMemory] = _index_in_background
    relations: Callable[[], RelationMemory] = RelationMemory


class Knowledge:
    """The learners of words, which know what the memory holds and nothing else.

    What is learned inside `together` is on disk when that ends; if anything fails, the
    memory and the learners are as they were. Errors of the memory are MemoryFileError.
    `learners` replaces the learners of nouns and relations.
    """

    def __init__(self, memory: Memory, learners: Learners | None = None) -> None:
        learners = Learners() if learners is None else learners
        self.memory, self._make_objects = memory, learners.objects
        self._undoing: ExitStack | None = None
        self.colours = ColourMemory(prior=xkcd())
        self.attributes = AttributeMemory()
        self.relations = learners.relations()
        self.generics = Generics()
        denied: list[View] = []
        self.objects = learners.objects(_views(memory, denied))
        for view in denied:
            self.objects.deny(view)
        for lesson in memory.attributes():
            shown = _palette_in(lesson.seen.traits)
            traits = _up_to_date(memory, lesson.key, lesson.seen.traits)
            self._learn_attribute(
                lesson.key, lesson.word.name, traits, shown, lesson.holds
            )
        for placed in memory.relations():
            stand = placed.seen.configuration
            self._learn_relation(placed.key, placed.word.name, stand, placed.holds)
        for known in memory.criteria():
            by, of, degree = known.seen.by, known.seen.name, known.seen.degree
            self._learn_criterion(known.key, known.word.name, by, of, degree)
        self._reckon_with_strangers()

    @contextmanager
    def together(self) -> Iterator[None]:
        """Keep all that is learned and forgotten inside, or none of it.

        Inside another `together` it is undone with that one.
        """
        outer = self._undoing
        with ExitStack() as undoing:
            self._undoing = undoing
            try:
                with self.memory.together():
                    yield
            finally:
                self._undoing = outer
            done = undoing.pop_all()
        if outer is not None:
            outer.callback(done.close)

    def learn_noun(
        self,
        name: str,
        surface: str,
        percept: Percept,
        evidence: LessonSource,
        *,
        article: str = "",
        holds: bool = True,
    ) -> int:
        """Learn that a thing is called so, or that it is not; returns the key."""
        seen = self._sighting(percept, evidence, self.objects.traits_of(percept))
        learn = self.objects.learn_one if holds else self.objects.deny_one
        with self.together():
            key = self.memory.learn_object(
                evidence.turn, name, surface, seen, article=article, holds=holds
            )
            learn(percept, name, key=key)
            self._undo(self.objects.forget, key)
            self._reckon_with_strangers()
        return key

    def learn_attribute(
        self,
        name: str,
        surface: str,
        percept: Percept,
        evidence: LessonSource,
        *,
        article: str = "",
        holds: bool = True,
    ) -> int:
        """Learn that a thing is so, or that it is not so; returns the key.

        A word for a colour that most people know is learned as one, any other as one of
        the tutor's own.
        """
        traits = dict(self.objects.traits_of(percept))
        palette = _palette_of(percept)
        if palette is not None:
            traits[PALETTE] = pack_palette(palette)
        seen = self._sighting(percept, evidence, traits)
        shown = _palette_in(traits)
        with self.together():
            key = self.memory.learn_attribute(
                evidence.turn, name, surface, seen, article=article, holds=holds
            )
            self._learn_attribute(key, name, _of_cues(traits), shown, holds)
            learner = self._learner_of(name, shown)
            self._undo(learner.forget, key)
        return key

    def learn_relation(
        self,
        name: str,
        surface: str,
        things: tuple[Named, Named],
        stand: Configuration,
        evidence: LessonSource,
        *,
        article: str = "",
        holds: bool = True,
    ) -> int:
        """Learn that two things stand so, or that they do not; returns the key."""
        (target, percept), (landmark, other) = things
        picture = _picture(percept, other.region)
        seen = Arrangement(
            evidence.sensor, evidence.time, target, landmark, stand, picture
        )
        with self.together():
            key = self.memory.learn_relation(
                evidence.turn, name, surface, seen, article=article, holds=holds
            )
            self._learn_relation(key, name, stand, holds)
            self._undo(self.relations.forget, key)
        return key

    def learn_kind(self, turn: Turn, lower: Word, upper: Word) -> int:
        """Learn that a kind of thing is a kind of another; returns the key."""
        with self.together():
            return self.memory.learn_kind(turn, lower, upper)

    def learn_criterion(
        self, turn: Turn, noun: Word, by: By, criterion: Word, degree: float
    ) -> int:
        """Learn by what the things of a noun are known; returns the key.

        A cue counts, or does not; a quality is evidence for the noun. Parts cannot be
        seen: they are kept as they were said.
        """
        with self.together():
            key = self.memory.learn_criterion(turn, noun, by, criterion, degree)
            self._learn_criterion(key, noun.name, by, criterion.name, degree)
            learner = self._learner_by(by)
            if learner is not None:
                self._undo(learner.forget, key)
        return key

    def forget(self, key: int) -> None:
        """Forget a lesson, as if it had never been. Raises NoSuchLessonError."""
        with self.together():
            lesson = self.memory.lesson(key)
            self.memory.forget(key)
            self._forget(lesson)
            self._reckon_with_strangers()

    def forget_word(self, kind: Kind, name: str) -> tuple[int, ...]:
        """Forget a word with all its lessons; returns their keys.

        Raises NoSuchLessonError for a word that was never taught.
        """
        with self.together():
            keys = self.memory.keys_of(kind, name)
            lessons = [self.memory.lesson(key) for key in keys]
            self.memory.forget_word(kind, name)
            self._forget(*lessons)
            self._reckon_with_strangers()
        return keys

    def hindsight(self, name: str, latest: int) -> Iterator[bool]:
        """Whether it would have been right before each of the latest lessons in a noun.

        It is worked out bit by bit, by what is known now, and may be so in another
        thread.
        """
        holding = [PastLesson(it, True) for it in self.objects.views]
        denying = [PastLesson(it, False) for it in self.objects.denied]
        lessons = sorted([*holding, *denying], key=lambda it: _order(it.view.key))
        return was_right(lessons, name, latest, self._make_objects)

    def qualities_of(self, key: int) -> Mapping[str, float] | None:
        """How probably each adjective is true of what a lesson in a noun showed.

        None for a lesson that denies its noun, or of which no picture was kept.
        """
        lesson = self.memory.lesson(key)
        if not isinstance(lesson, ObjectLesson) or not lesson.holds:
            return None
        picture = self.memory.picture(key)
        if picture is None or picture.crop is None:
            return None
        try:
            palette = colours_of(*restore_crop(picture.crop))
        except ValueError:
            return None
        named = {} if palette is None else self.colours.degrees(palette)
        return {
            **self.attributes.degrees(_of_cues(lesson.seen.traits)),
            **{f"{SAID_OF_THINGS}{predicate_name(it)}": p for it, p in named.items()},
        }

    # --- why -------------------------------------------------------------------------

    def reasons(
        self,
        word: str,
        percept: Percept,
        rival: str | None = None,
        *,
        heard: Heard | None = None,
    ) -> Reasons:
        """Why a thing is called by this noun, and not by a rival.

        Cues that were said not to matter for the noun are no reasons for it.
        By default the rival is the best other noun. `heard` is the evidence, if it is
        known already. KeyError for a noun that was not learned.
        """
        evidence = self.objects.evidence(percept) if heard is None else heard
        degrees = evidence.degrees()
        rival, margin = best_rival(word, degrees, rival)
        against = rival if rival in degrees else None
        view = self.objects.nearest(percept, word)
        added = evidence.reasons(word, against) if word in degrees else {}
        counts = self.objects.relevance(word)
        cues = shares_of({it: x for it, x in added.items() if not counts.ignores(it)})
        lesson = self._lesson(None if view is None else view.key)
        return Reasons(word, degrees.get(word, 0.0), cues, lesson, rival, margin)

    def attribute_reasons(self, word: str, percept: Percept) -> Reasons:
        """Why a thing is described by this adjective.

        KeyError for a word that is not known.
        """
        palette, colour = _palette_of(percept), colour_named(self.colours, word)
        if colour is not None:
            if palette is None:
                return Reasons(word, 0.0, (), None, None, None)
            degrees = self.colours.degrees(palette)
            found = self._lesson(self.colours.nearest(palette, colour))
            cues = (Share("colour", 1.0),)
            return Reasons(word, degrees[colour], cues, found, None, None)
        traits = self.objects.traits_of(percept)
        spoken_of = self.attributes.speaks_of(word)
        degree = self.attributes.degrees(traits)[word]
        nearest = self._lesson(self.attributes.nearest(traits, word))
        return Reasons(word, degree, shares_of(spoken_of), nearest, None, None)

    def relation_reasons(
        self, word: str, stand: Configuration, rival: str | None = None
    ) -> Reasons:
        """Why this relation is said of things that stand so.

        KeyError for a relation that was not learned.
        """
        nearest = self._lesson(self.relations.nearest(stand, word))
        degrees = self.relations.degrees(stand)
        rival, margin = best_rival(word, degrees, rival)
        cues = (Share("configuration", 1.0),)
        return Reasons(word, degrees[word], cues, nearest, rival, margin)

    # --- learners --------------------------------------------------------------------

    def _undo(self, undo: Callable[..., object], *given: object) -> None:
        """Register an undo, in case the enclosing `together` fails."""
        if self._undoing is not None:
            self._undoing.callback(undo, *given)

    def _reckon_with_strangers(self) -> None:
        """Reckon with as many strangers as there were among the things told about."""
        self._undo(self.objects.reckon_with, self.objects.familiarity)
        self.objects.reckon_with(find_familiarity(self.memory))

    def _forget(self, *lessons: Lesson) -> None:
        """Have the learners forget lessons; undo restores them in order."""
        taught = [
            (learner, lesson.key)
            for lesson in lessons
            if (learner := self._learner_of_lesson(lesson)) is not None
        ]
        for learner in {id(learner): learner for learner, _ in taught}.values():
            self._undo(learner.become, learner.copy())
        for learner, key in taught:
            learner.forget(key)

    def _learner_of_lesson(self, lesson: Lesson) -> _Learner | None:
        """The learner of a lesson; None for what is only remembered."""
        match lesson:
            case KindLesson():
                return None
            case CriterionLesson():
                return self._learner_by(lesson.seen.by)
            case RelationLesson():
                return self.relations
            case ObjectLesson() if lesson.word.kind == "attribute":
                shown = _palette_in(lesson.seen.traits)
                return self._learner_of(lesson.word.name, shown)
        return self.objects

    def _learner_of(self, name: str, shown: Palette | None) -> _Learner:
        colour = colour_named(self.colours, name)
        unknown = shown is None or colour is None
        return self.attributes if unknown else self.colours

    def _learner_by(self, by: By) -> _Learner | None:
        """The learner of what things are known by; None for what cannot be seen."""
        match by:
            case "cue":
                return self.objects
            case "quality":
                return self.generics
        return None

    def _learn_criterion(
        self, key: int, noun: str, by: By, name: str, degree: float
    ) -> None:
        if by == "cue":
            self.objects.weigh(noun, name, degree > 0.0, key=key)
        if by == "quality":
            self.generics.learn_one(Generic(noun, name, degree), key=key)

    def _learn_attribute(
        self, key: int, name: str, traits: Traits, shown: Palette | None, holds: bool
    ) -> None:
        colour = colour_named(self.colours, name)
        if shown is not None and colour is not None:
            learn = self.colours.learn_one if holds else self.colours.deny_one
            learn(shown, colour, key=key)
            return
        teach = self.attributes.learn_one if holds else self.attributes.deny_one
        teach(traits, name, key=key)

    def _learn_relation(
        self, key: int, name: str, stand: Configuration, holds: bool
    ) -> None:
        if holds:
            self.relations.learn_one(stand, name, key=key)
        else:
            self.relations.judge_one(stand, name, 0.0, key=key)

    def _lesson(self, key: Key | None) -> Lesson | None:
        return self.memory.lesson(key) if isinstance(key, int) else None

    def _sighting(
        self, percept: Percept, evidence: LessonSource, traits: Traits
    ) -> Sighting:
        features = kept_features(percept)
        return Sighting(
            evidence.sensor,
            evidence.time,
            (Scan(features.descriptors, features.points),),
            percept.region.place,
            traits,
            _picture(percept),
        )


class _Learner(Protocol):
    """What all learners have in common."""

    def forget(self, key: Key) -> None: ...

    def copy(self) -> Self: ...

    def become(self, other: Self) -> None: ...


def colour_named(colours: ColourMemory, word: str) -> str | None:
    """The colour that the predicate of an adjective is named after, if it is known.

    >>> colour_named(ColourMemory(prior=xkcd()), "is_light_blue")
    'light blue'
    """
    colour = word.removeprefix(SAID_OF_THINGS).replace("_", " ")
    return colour if colours.knows(colour) else None


def _picture(percept: Percept, *others: Region) -> Picture | None:
    """The picture kept of what was seen; None for a thing that was only described."""
    frame = percept.frame
    return None if frame is None else evidence_of(frame, percept.region, *others)


def _palette_of(percept: Percept) -> Palette | None:
    """The colours of a thing; None if it has none, or was only described."""
    frame = percept.frame
    return None if frame is None else colours_of(frame, percept.region)


def _palette_in(traits: Traits) -> Palette | None:
    """The colours that were kept with a lesson, if any were."""
    try:
        return unpack_palette(traits[PALETTE]) if PALETTE in traits else None
    except ValueError:  # a memory may have been made by another program
        return None


def _of_cues(traits: Traits) -> Traits:
    """The traits that cues of today have measured."""
    return {
        cue: vector
        for cue, vector in traits.items()
        if _CUE_LENGTHS.get(cue) == len(vector)
    }


def _order(key: Key) -> int:
    assert isinstance(key, int)  # as the memory counts them
    return key


def _views(memory: Memory, denied: list[View]) -> Iterator[View]:
    """The views of the lessons in nouns; denied ones go into the list `denied`.

    What was seen in very many lessons is read when it is needed.
    """
    late = memory.late_reader()
    for view, holds in (
        _all_views(memory) if late is None else _late_views(memory, late)
    ):
        if holds:
            yield view
        else:
            denied.append(view)


def _all_views(memory: Memory) -> Iterator[tuple[View, bool]]:
    for lesson in memory.objects():
        traits = _up_to_date(memory, lesson.key, lesson.seen.traits)
        descriptors = _stack_scans([it.descriptors for it in lesson.seen.scans])
        yield View(lesson.key, lesson.word.name, descriptors, traits), lesson.holds


def _late_views(memory: Memory, late: LateReader) -> Iterator[tuple[View, bool]]:
    source = _LateLessons(late)
    for key, name, holds, features in memory.outlines():
        yield LateView(key, name, features, source), holds


@dataclass(frozen=True)
class _LateLessons:
    """What was seen in lessons, read when it is asked for."""

    late: LateReader

    def descriptors(self, keys: Sequence[Key]) -> Sequence[Descriptors]:
        with _gone_if_closed():
            found = self.late.descriptors([_order(key) for key in keys])
        return [_stack_scans(blocks) for blocks in found]

    def traits(self, keys: Sequence[Key]) -> Sequence[Traits]:
        numbers = [_order(key) for key in keys]
        with _gone_if_closed():
            found = self.late.traits(numbers)
            return [
                _up_to_date(self.late, key, traits)
                for key, traits in zip(numbers, found, strict=True)
            ]


@contextmanager
def _gone_if_closed() -> Iterator[None]:
    try:
        yield
    except MemoryClosedError as error:
        raise GoneError(str(error)) from error


def _stack_scans(blocks: Sequence[Descriptors]) -> Descriptors:
    """The descriptors of some scans together."""
    if len(blocks) == 1:
        return blocks[0]
    return np.concatenate([NONE.descriptors, *blocks])


class _Pictures(Protocol):
    """What has the pictures of lessons."""

    def picture(self, key: int) -> Picture | None: ...


def _up_to_date(memory: _Pictures, key: int, traits: Traits) -> Traits:
    """The traits of a lesson, measured again if a cue has changed since."""
    kept = _of_cues(traits)
    if kept and len(kept) == len(traits) - (PALETTE in traits):
        return kept
    picture = memory.picture(key)
    if picture is None or picture.crop is None:
        return kept
    try:
        return measure_cues(*restore_crop(picture.crop))
    except ValueError:  # a picture that another program made, and nobody can read
        return kept
