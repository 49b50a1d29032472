"""Setting the noun phrases of what is said to things in view, all of them together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import product
from math import prod
from typing import NamedTuple, TypeVar

from kille.dialogue.meanings import (
    DialogueTypes,
    is_denial,
    packaged_types,
    set_at,
    set_to,
    value_at,
    word_of,
)
from kille.dialogue.reference.demonstratives import in_talk, shown_things
from kille.dialogue.reference.parts import Claim, PhraseParts, take_apart
from kille.dialogue.reference.perspectives import front_of
from kille.dialogue.reference.salience import (
    choose,
    choosing_predicates,
    just_mentioned,
    needs_salience,
)
from kille.dialogue.taxonomy import has_kind, is_kind_of
from ttr import Model, Pred, Record, RecordType, rectype
from ttr.safety.budgets import cache_in_question
from ttr.types import Singleton, TypeNode
from ttr.types.objects import Object

PARTS = ("target", "landmark")
"""The labels of the noun phrases in a content.

>>> from kille.dialogue.meanings import relation
>>> from kille.dialogue.reference import PARTS
>>> print(*(relation("behind").meaning[label] for label in PARTS))
[look = ^.look : Look, x : Ind] [look = ^.look : Look, x : Ind]
"""

INSIDE = "inside"
"""The role of what a phrase mentions besides its own thing."""


class PhraseFit(NamedTuple):
    """How well a thing fits a phrase: all claims together, and the weakest claim.

    `firm` is the weakest claim that is not vague; adjectives are vague. `things` are
    the thing itself, what it stands beside, what that stands beside …
    """

    p: float
    weakest: float
    firm: float
    things: tuple[str, ...]


@dataclass(frozen=True)
class Reading:
    """A way to set the phrases of a content to things, and how probably they fit.

    >>> from kille.dialogue.state import initial
    >>> from kille.dialogue.meanings import meaning_in
    >>> fit = PhraseFit(p=0.8, weakest=0.8, firm=0.9, things=("o1",))
    >>> reading = Reading(initial(), meaning_in("cup", "Naming"), (("target", fit),))
    >>> reading.p, reading.things
    (0.8, {'target': 'o1'})
    >>> print(reading.content["target"])
    [look = ^.look : Look, x = o1 : Ind]
    """

    s: Record
    open: RecordType
    fits: tuple[tuple[str, PhraseFit], ...]
    types: DialogueTypes | None = None

    @cached_property
    def p(self) -> float:
        """How probably all phrases are true of their things."""
        return prod(fit.p for _, fit in self.fits)

    @property
    def weakest(self) -> float:
        """How probable the least probable claim is."""
        return min((fit.weakest for _, fit in self.fits), default=1.0)

    @property
    def firm(self) -> float:
        """How probable the least probable claim is of those that are not vague."""
        return min((fit.firm for _, fit in self.fits), default=1.0)

    @property
    def things(self) -> dict[str, str]:
        """The thing of each phrase."""
        return {label: fit.things[0] for label, fit in self.fits}

    @cached_property
    def content(self) -> RecordType:
        """The content with its phrases set to these things, and its perspectives."""
        s, content, types = self.s, self.open, self.types or packaged_types()
        for label, fit in self.fits:
            phrase = _set_phrase(s, phrase_at(content, label), fit.things, types=types)
            content = set_to(content, **{label: phrase})
        return in_view(s, content, types=types)


_Found = TypeVar("_Found", PhraseFit, Reading)


def phrases(content: RecordType) -> tuple[str, ...]:
    """The labels of the phrases in a content that are not set to any thing yet.

    >>> from kille.dialogue.meanings import meaning_in, set_at
    >>> content = meaning_in("cup", "Naming")
    >>> phrases(content), phrases(set_at(content, "target.x", "o1"))
    (('target',), ())
    """
    return tuple(
        label
        for label in PARTS
        if label in content and thing_at(content, label) is None
    )


def thing_at(content: RecordType, label: str) -> str | None:
    """The thing that a phrase is set to.

    >>> from kille.dialogue.meanings import meaning_in
    >>> thing_at(set_at(meaning_in("cup", "Naming"), "target.x", "o1"), "target")
    'o1'
    """
    part = content.get(label)
    if isinstance(part, RecordType) and isinstance(part["x"], Singleton):
        return str(part["x"].value)
    return None


def taught_words(s: Record) -> Mapping[tuple[Pred, str], bool]:
    """The words that the tutor has said, or denied, of things in view.

    So are those that follow from it by the axioms of kinds of things.
    """
    here = frozenset(s.shared.here) if s.private.lessons else frozenset()
    told: dict[tuple[Pred, str], bool] = {}
    for it in s.private.lessons if here else ():
        content = it.content
        if content in here:
            x, so = _taught_thing(content)
            if x is not None:
                told[word_of(it.sign), x] = so
    if not s.private.kinds:
        return told
    found = dict(told)
    nouns = [it for it in s.private.nouns if has_kind(s, it)]
    for lower, upper in product(nouns, repeat=2):
        if not is_kind_of(s, lower, upper):
            continue
        for (word, x), so in told.items():
            if so and word is word_of(lower):
                found.setdefault((word_of(upper), x), True)
            if not so and word is word_of(upper):
                found.setdefault((word_of(lower), x), False)
    return found


@lru_cache(4096)
def _taught_thing(content: RecordType) -> tuple[str | None, bool]:
    """The thing of which a lesson says a word, or denies it; None if there are two."""
    x = None if "rel" in content else thing_at(content, "target")
    return x, not is_denial(content)


def phrase_at(content: RecordType, label: str) -> RecordType:
    """The phrase of a content that has this label.

    >>> from kille.dialogue.meanings import meaning_in
    >>> print(phrase_at(meaning_in("cup", "Naming"), "target"))
    [look = ^.look : Look, x : Ind]
    """
    phrase = content[label]
    if not isinstance(phrase, RecordType):
        raise TypeError(f"the phrase {label} of {content} is no record type")
    return phrase


def in_view(
    s: Record, content: RecordType, *, types: DialogueTypes | None = None
) -> RecordType:
    """The content as it is seen now: in the latest look, and in its perspective.

    The perspective is that of the talk, where the content does not have one of its own.

    >>> from kille.dialogue.meanings import meaning_in
    >>> from kille.dialogue.state import initial
    >>> print(in_view(initial(), meaning_in("cup", "Naming"))["look"])
    Look@look0
    """
    types = types or packaged_types()
    if "look" not in content:
        return content
    now = types["Look"] @ s.view.look
    content = content if content["look"] is now else set_to(content, look=now)
    landmark = thing_at(content, "landmark")
    if landmark is None or "frame" not in content:
        return content
    if isinstance(content["frame"], Singleton):
        return content
    return set_at(content, "frame", front_of(s, landmark))


def things_in(content: RecordType) -> list[str]:
    """The things that a content is set to, those of its phrases first.

    >>> from kille.dialogue.meanings import meaning_in
    >>> things_in(set_at(meaning_in("cup", "Naming"), "target.x", "o1"))
    ['o1']
    """
    return list(roles_in(content))


def roles_in(content: RecordType) -> dict[str, str]:
    """The things that a content is set to, each with its role there.

    It is the label of a phrase, or `inside` for what stands in a phrase.

    >>> from kille.dialogue.meanings import meaning_in
    >>> roles_in(set_at(meaning_in("cup", "Naming"), "target.x", "o1"))
    {'o1': 'target'}
    """
    things = {x: it for it in PARTS if (x := thing_at(content, it)) is not None}
    for label in PARTS:
        if isinstance(part := content.get(label), RecordType):
            for x in roles_in(part):
                things.setdefault(x, INSIDE)
    return things


def possible_readings(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes | None = None
) -> Sequence[Reading]:
    """The ways in which the phrases of a content can be set to things in view.

    Two phrases are set to two things. Readings without any probability are left out.

    >>> from kille.dialogue.language import understand
    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> run = game.take(game.begin(), game.hear("This is a cup.")).run
    >>> [said] = understand("Where is the cup?")
    >>> found = possible_readings(run.state, run.model, said.readings[0].content)
    >>> [it.things for it in found]
    [{'target': 'o1'}]
    """
    types = types or packaged_types()
    content = _take_from_claim(s, content, types=types)
    judging = phrase_judge(s, model, types=types)
    open_ = phrases(content)
    taken = {thing_at(content, label) for label in PARTS if label not in open_}
    found: dict[str, Mapping[str, PhraseFit]] = {}
    about_it: list[tuple[str, RecordType]] = []
    for label in open_:
        phrase = phrase_at(content, label)
        if needs_salience(phrase, types):
            about_it.append((label, phrase))
            continue
        among = _things_without_words(s, phrase, types=types)
        found[label] = judging.fits(phrase, among)
    for label, phrase in about_it:
        others = taken.union(*(_only_one(s, it) for it in found.values()))
        among = [x for x in s.view.things if x not in others]
        found[label] = judging.fits(phrase, among)
    choices = [
        [(label, fit) for x, fit in found[label].items() if x not in taken]
        for label in open_
    ]
    return [
        Reading(s, content, fits, types=types)
        for fits in product(*choices)
        if len({fit.things[0] for _, fit in fits}) == len(fits)
    ]


def _only_one(s: Record, fits: Mapping[str, PhraseFit]) -> Sequence[str]:
    """What a phrase means, if only one thing fits it well: "it" is another one."""
    well = fits_well(s, fits)
    return well if len(well) == 1 else ()


def _take_from_claim(
    s: Record, content: RecordType, *, types: DialogueTypes
) -> RecordType:
    """The content about the things of the claim that it answers: "No, behind it."

    Only where it says in words of neither of two things which it is.
    """
    claim = s.shared.pending[0] if s.shared.pending else content
    if "rel" not in content or "rel" not in claim or not phrases(content):
        return content
    target, landmark = (phrase_at(content, part) for part in PARTS)
    plain, it = types.record_type("Phrase"), types.record_type("It")["d"]
    if target.labels != plain.labels or landmark.get("d") not in (None, it):
        return content
    if set(landmark.labels) - {"x", "look", "d"}:
        return content
    return set_to(content, **{part: phrase_at(claim, part) for part in PARTS})


def _things_without_words(
    s: Record, phrase: RecordType, *, types: DialogueTypes
) -> Sequence[str] | None:
    """The things that a phrase without words may mean, as in "No, a mug."

    These are the things that the robot has claimed something of, or else those shown.
    Who points at another one meanwhile means that. None for a phrase with words.
    """
    if phrase.labels != types.record_type("Phrase").labels:
        return None
    claimed = {thing_at(claim, "target") for claim in s.shared.pending[:1]}
    if s.view.pointed and claimed.isdisjoint(s.view.pointed):
        return shown_things(s)
    return [x for x in s.view.things if x in claimed] or shown_things(s)


def fitting_readings(s: Record, readings: Iterable[Reading]) -> list[Reading]:
    """The readings worth thinking of, the most probable first.

    >>> from kille.dialogue.language import understand
    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> run = game.take(game.begin(), game.hear("This is a cup.")).run
    >>> [said] = understand("Where is the cup?")
    >>> found = possible_readings(run.state, run.model, said.readings[0].content)
    >>> [it.things for it in fitting_readings(run.state, found)]
    [{'target': 'o1'}]
    """
    return _worth_thinking_of(s, readings)


def fits_well(s: Record, fits: Mapping[str, PhraseFit]) -> list[str]:
    """The things that fit a phrase so well that they are worth thinking of.

    >>> from kille.dialogue.state import initial
    >>> fits = {
    ...     "o1": PhraseFit(p=0.9, weakest=0.9, firm=0.9, things=("o1",)),
    ...     "o2": PhraseFit(p=0.1, weakest=0.1, firm=0.1, things=("o2",)),
    ... }
    >>> fits_well(initial(), fits)
    ['o1']
    """
    return [fit.things[0] for fit in _worth_thinking_of(s, fits.values())]


def _worth_thinking_of(s: Record, found: Iterable[_Found]) -> list[_Found]:
    """The likely ones, as far as they are nearly as probable as the best.

    Each word must be likely enough to be true. But qualities are vague: if nothing is
    likely to be a red apple, the only thing that might be one is meant.
    """
    bands, found = s.private.strategy.bands, list(found)
    likely = [it for it in found if it.weakest >= bands.likely]
    near = _near(bands.sure, likely)
    if near:
        return near
    vague = [
        it for it in found if it.firm >= bands.likely and it.weakest >= bands.might
    ]
    near = _near(bands.sure, vague)
    return near if len(near) == 1 else []


def _near(share: float, found: Sequence[_Found]) -> list[_Found]:
    """Those that are at least this share as probable as the best, the best first."""
    best = max((it.p for it in found), default=0.0)
    return sorted((it for it in found if it.p >= share * best), key=lambda it: -it.p)


def intended_readings(
    s: Record, readings: Iterable[Reading], *, types: DialogueTypes | None = None
) -> list[Reading]:
    """The readings that are meant: one, unless the talk leaves open which.

    If a phrase fits several things, the one that was just talked about is meant. It is
    not if the phrase says how its thing is, and another is more so: "The red one is a
    cup. The blue one is …".

    >>> from kille.dialogue.language import understand
    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> run = game.take(game.begin(), game.hear("This is a cup.")).run
    >>> [said] = understand("Where is the cup?")
    >>> found = possible_readings(run.state, run.model, said.readings[0].content)
    >>> [it.things for it in intended_readings(run.state, found)]
    [{'target': 'o1'}]
    """
    types = types or packaged_types()
    meant = fitting_readings(s, readings)
    for label in PARTS:
        things = {it.things[label] for it in meant if label in it.things}
        latest = just_mentioned(s, things)
        if latest is None:
            continue
        if _fits_another_better(meant, label, latest):
            meant = [it for it in meant if it.things.get(label) != latest]
        else:
            meant = [
                it
                for it in meant
                if it.things[label] == latest
                or _chooses(phrase_at(it.open, label), types=types)
            ]
    return meant


def _fits_another_better(meant: Sequence[Reading], label: str, x: str) -> bool:
    """Whether a phrase says how its thing is, and another thing is more so."""
    best = meant[0]
    return "a" in phrase_at(best.open, label) and best.things[label] != x


def _chooses(phrase: RecordType, *, types: DialogueTypes) -> bool:
    """Whether a phrase says by itself which of several things it speaks of.

    So does "that": where it may be several things, it is told from "this". "It" is the
    most salient one, by the talk as well.
    """
    if phrase.get("d") == types.record_type("That")["d"]:
        return True
    return bool(take_apart(phrase, types.derive(choosing_predicates)).choices)


class PhraseJudge:
    """Judges phrases of the things in view, in one state: each claim once.

    >>> from kille.dialogue.meanings import noun
    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> run = game.take(game.begin(), game.hear("This is a cup.")).run
    >>> fits = PhraseJudge(run.state, run.model).fits(noun("cup").meaning)
    >>> round(fits["o1"].p, 1)
    1.0
    """

    def __init__(
        self, s: Record, model: Model, *, types: DialogueTypes | None = None
    ) -> None:
        self._types = types or packaged_types()
        self._s, self._model = s, in_talk(s, model, types=self._types)
        self._taught = taught_words(s)
        self._degrees: dict[Claim, float] = {}

    def fits(
        self, phrase: RecordType, among: Sequence[str] | None = None
    ) -> dict[str, PhraseFit]:
        """How well each thing in view, or each of these, fits a phrase."""
        phrase = set_numbered(self._s, phrase, types=self._types)
        return self.fits_part(
            take_apart(phrase, self._types.derive(choosing_predicates)), among
        )

    def fits_part(
        self, part: PhraseParts, among: Sequence[str] | None = None
    ) -> dict[str, PhraseFit]:
        """How well each thing in view, or each of these, fits a phrase taken apart."""
        return self._fits(part, self._s.view.things if among is None else among)

    def _fits(self, part: PhraseParts, among: Sequence[str]) -> dict[str, PhraseFit]:
        things = among if part.thing is None else [part.thing]
        things = [x for x in things if x in self._s.view.things]
        found = {x: fit for x in things if (fit := self._alone(part, x)).p > 0.0}
        if part.landmark is not None:
            found = dict(self._beside(part, part.landmark, found))
        for pred in part.choices:
            fitting = fits_well(self._s, found)
            left = choose(self._s, self._model, pred, fitting, types=self._types)
            found = {x: found[x] for x in left}
        return found

    def _alone(self, part: PhraseParts, x: str) -> PhraseFit:
        claims = part.said_of(x, self._s.view.look)
        judged = [(P, self.degree(P, *args)) for P, args in claims]
        degrees = [p for _, p in judged]
        firm = [p for P, p in judged if P not in part.qualities]
        weakest = min(degrees, default=1.0)
        return PhraseFit(prod(degrees), weakest, min(firm, default=1.0), (x,))

    def _beside(
        self, part: PhraseParts, landmark: PhraseParts, found: dict[str, PhraseFit]
    ) -> Iterator[tuple[str, PhraseFit]]:
        """Each thing with the landmark that fits it best."""
        beside = self._fits(landmark, self._s.view.things)
        nearby = sorted(beside.values(), key=lambda fit: -fit.p)
        for x, alone in found.items():
            best: PhraseFit | None = None
            for other in nearby:
                if best is not None and alone.p * other.p <= best.p:
                    break  # no relation is more than certain
                if x not in other.things:
                    both = self._both(part, alone, other)
                    best = both if best is None or both.p > best.p else best
            if best is not None and best.p > 0.0:
                yield x, best

    def _both(self, part: PhraseParts, alone: PhraseFit, other: PhraseFit) -> PhraseFit:
        (x,), (y, *further) = alone.things, other.things
        s = self._s
        third = further[0] if further else ""
        claims = part.said_of_both(x, y, s.view.look, front_of(s, y), third)
        degrees = [self.degree(P, *args) for P, args in claims]
        return PhraseFit(
            alone.p * other.p * prod(degrees),
            min((alone.weakest, other.weakest, *degrees)),
            min((alone.firm, other.firm, *degrees)),
            (x, *other.things),
        )

    def degree(self, pred: Pred, *args: Object) -> float:
        """How probable a claim is, by the witness function of its predicate.

        What the tutor has said of a thing in view is certain.
        """
        claim = pred, args
        known = self._degrees.get(claim)
        if known is None and self._taught and len(args) == 2:
            taught = self._taught.get((pred, str(args[0])))
            if taught is not None:
                known = self._degrees[claim] = float(taught)
        if known is None:
            seen = self._model.facts.perceive(None, pred(*args))
            known = self._degrees[claim] = 0.0 if seen is None else seen.lo
        return known


@cache_in_question
def phrase_judge(s: Record, model: Model, *, types: DialogueTypes) -> PhraseJudge:
    """The judge of phrases in a state: one for all rules that ask in a turn."""
    return PhraseJudge(s, model, types=types)


NUMBER = "number"
"""The label of the number by which a phrase calls its thing: "#2"."""


def set_numbered(s: Record, phrase: RecordType, *, types: DialogueTypes) -> RecordType:
    """The phrase, set to the thing in view that has its number, if it has one.

    So are the phrases in it. A number that nothing in view has is that of something
    else, which fits nothing.
    """
    inner = phrase.get("landmark")
    if isinstance(inner, RecordType):
        found = set_numbered(s, inner, types=types)
        phrase = phrase if found is inner else set_to(phrase, landmark=found)
    if NUMBER not in phrase or isinstance(phrase["x"], Singleton):
        return phrase
    things = dict(enumerate(s.view.things, start=1))
    number = int(str(value_at(phrase, NUMBER)))
    return set_to(phrase, x=types["Ind"] @ things.get(number, f"#{number}"))


def _set_phrase(
    s: Record, phrase: RecordType, things: tuple[str, ...], *, types: DialogueTypes
) -> RecordType:
    """The phrase set to a thing, and to what that stands beside, as seen from there.

    Claims that held only at that point of the talk (`d`) are dropped.
    """
    x, *beside = things
    fields: dict[str, TypeNode] = {"x": types["Ind"] @ x}
    if beside:
        landmark = phrase_at(phrase, "landmark")
        fields["landmark"] = _set_phrase(s, landmark, tuple(beside), types=types)
        fields["frame"] = types["Front"] @ front_of(s, beside[0])
    return _set_beyond_talk(phrase, **fields)


@lru_cache(4096)
def _set_beyond_talk(phrase: RecordType, **fields: TypeNode) -> RecordType:
    """The phrase with these fields, without what held at a point of the talk only."""
    kept = {label: T for label, T in phrase.fields if label != "d"}
    return rectype({**kept, **fields})
