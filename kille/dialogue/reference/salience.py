"""How salient things are, to the eye and in the talk, and which words choose by it.

The facts are fields of the state: `shared.sights` are how things look, and
`shared.noticed` is how they were attended to. How salient a thing x is follows from
them, in the weights of the strategy:

- to the eye, V(x) = Σ wᵢ·fᵢ(x) / Σ wᵢ, of its size, centrality and nearness, which are
  1/2 where nothing is known, and of how new it is;
- in the talk, L(x) = max w(role)·decay^(moves since then), over its roles;
- by both, S(x) = 1 − (1 − wᴸ·L(x))·(1 − wⱽ·V(x)), and 1 if it is pointed at now.

The rule `weigh_salience` of the games puts the degrees into the state when a move has a
word that needs them: another rule in its place weighs them otherwise. Other words
choose by the order of the talk, or from left to right: "the other cup", "the second
cup".

Source: Kelleher, Costello and van Genabith 2005 (visual and linguistic salience).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from kille.dialogue.meanings import DialogueTypes, is_denial, packaged_types
from kille.dialogue.reference.comparing import COMPARATIVES, unexceeded_things
from ttr import Model, Pred, Record, RecordType, record, replace
from ttr.types import Meet, PType, TypeNode

NEUTRAL = 0.5
"""The degree of what is not known of how a thing looks."""

SHOWN, NEW = "shown", "new"
"""The roles of a thing that is pointed at or put in front, and of one that is new."""

BEFORE = 0.5
"""How many moves before the next one is what is shown before it."""

# --- the facts -----------------------------------------------------------------------


def notice(
    known: Sequence[Record], roles: Mapping[str, str], move: float
) -> Sequence[Record]:
    """What is noticed when things are attended to in these roles, at this move.

    `roles` says for each thing in which role.
    """
    new = tuple(_notice(x, role, move) for x, role in roles.items())
    if known[: len(new)] == new:
        return known
    return (*new, *(it for it in known if roles.get(it.x) != it.role))


def notice_in_view(
    s: Record, shown: Iterable[str], new: Sequence[str], kept: Collection[str]
) -> Sequence[Record]:
    """What is noticed after a look: what is shown or new, without what is gone.

    It is noticed half a move before the next one. Where all is new, nothing is; beside
    what is new, nothing that was shown just before stands out.
    """
    known: Sequence[Record] = s.shared.noticed
    move = s.private.cost.turns + BEFORE
    if any(it.x not in kept for it in known):
        known = tuple(it for it in known if it.x in kept)
    if new and s.view.things:
        known = tuple(it for it in known if it.role != SHOWN or it.move != move)
        known = notice(known, dict.fromkeys(new, NEW), move)
    return notice(known, dict.fromkeys(shown, SHOWN), move)


@lru_cache(4096)
def _notice(x: str, role: str, move: float) -> Record:
    return record(x=x, role=role, move=move)


# --- the degrees ---------------------------------------------------------------------


class ThingSalience(NamedTuple):
    """How salient a thing is to the eye and in the talk, as degrees from 0 to 1.

    >>> cup = ThingSalience("o1", visual=0.5, linguistic=0.7, is_shown=False)
    >>> max(cup.visual, cup.linguistic)
    0.7
    """

    x: str
    visual: float
    linguistic: float
    is_shown: bool
    """Whether it has been pointed at, or put in front, since the latest move."""


Combine = Callable[[ThingSalience, Record], float]
"""How salient a thing is altogether, in weights of type `Weights`, from 0 to 1."""


def thing_saliences(s: Record) -> list[ThingSalience]:
    """How salient the things in view are, and those that are talked about.

    What is shown now is to the eye of degree 1.

    >>> from kille.dialogue.state import initial
    >>> s = replace(initial(), {"view.things": ["o1", "o2"], "shared.salient": ["o2"]})
    >>> for it in thing_saliences(s):
    ...     print(it.x, it.visual, it.linguistic)
    o1 0.375 0.0
    o2 0.375 0.7
    """
    weights = s.private.strategy.salience
    now, decay, roles = s.private.cost.turns + 1.0, weights.decay, weights.roles
    salient = s.shared.salient
    said = {x: decay ** (1 + rank) for rank, x in enumerate(salient)}
    fresh: dict[str, float] = {}
    shown = set(() if s.shared.noticed or salient else s.view.pointed)
    noticed: set[str] = set()
    for it in s.shared.noticed:
        x, role, age = it.x, it.role, max(0.0, now - it.move)
        if role == NEW:
            fresh[x] = decay**age
        elif role in roles:
            strength = roles[role] * decay**age
            said[x] = max(strength, said[x]) if x in noticed else strength
            noticed.add(x)
        if role == SHOWN and age <= BEFORE:
            shown.add(x)
    sights = {it.x: it for it in s.shared.sights}
    return [
        ThingSalience(
            x,
            1.0 if x in shown else _looks(sights.get(x), fresh.get(x, 0.0), weights),
            said.get(x, 0.0),
            x in shown,
        )
        for x in dict.fromkeys((*s.view.things, *salient))
    ]


def _looks(sight: Record | None, fresh: float, weights: Record) -> float:
    """How salient a thing is by how it looks, and how new it is."""
    of = weights.sights
    size, central, near = (
        (NEUTRAL, NEUTRAL, NEUTRAL)
        if sight is None
        else (sight.size, sight.centrality, sight.nearness)
    )
    whole = of.size + of.centrality + of.nearness + of.new
    part = of.size * size + of.centrality * central + of.nearness * near
    return float((part + of.new * fresh) / whole) if whole else 0.0


def combined_salience(it: ThingSalience, weights: Record) -> float:
    """How salient a thing is to the eye and in the talk; what is shown now most of all.

    >>> from kille.dialogue.strategies import strategy
    >>> combined_salience(ThingSalience("o1", 1.0, 0.5, False), strategy().salience)
    0.575
    """
    if it.is_shown:
        return 1.0
    said = min(1.0, weights.linguistic * it.linguistic)
    seen = min(1.0, weights.visual * it.visual)
    return float(1.0 - (1.0 - said) * (1.0 - seen))


def set_salience(s: Record, combine: Combine = combined_salience) -> Record:
    """The state with how salient things are, by a combination of one's own.

    >>> from kille.dialogue.state import initial
    >>> s = replace(initial(), {"view.things": ["o1", "o2"], "shared.salient": ["o2"]})
    >>> by_talk = set_salience(s, lambda it, weights: it.linguistic)
    >>> [it.degree for it in by_talk.shared.salience]
    [0.0, 0.7]
    """
    weights = s.private.strategy.salience
    degrees = [
        record(
            x=it.x,
            visual=round(it.visual, _DIGITS),
            linguistic=round(it.linguistic, _DIGITS),
            degree=round(float(combine(it, weights)), _DIGITS),
        )
        for it in thing_saliences(s)
    ]
    return replace(s, {"shared.salience": degrees})


_DIGITS = 4
"""Decimals of a degree in the state, where it is to be read as well."""


def saliences(s: Record) -> Mapping[str, float]:
    """How salient things are: as a rule has weighed it, or else as the robot does.

    >>> from kille.dialogue.state import initial
    >>> saliences(replace(initial(), {"view.things": ["o1"], "view.pointed": ["o1"]}))
    {'o1': 1.0}
    """
    if s.shared.salience:
        return {it.x: it.degree for it in s.shared.salience}
    weights = s.private.strategy.salience
    return {it.x: combined_salience(it, weights) for it in thing_saliences(s)}


def is_talked_of(s: Record, things: Iterable[str]) -> bool:
    """Whether some of these things are still salient in the talk."""
    margin, among = s.private.strategy.salience.margin, set(things)
    return any(it.linguistic > margin for it in thing_saliences(s) if it.x in among)


def nearness(s: Record, x: str) -> float:
    """How near a thing is, beside the nearest one; 1/2 where nothing is known."""
    near = (float(it.nearness) for it in s.shared.sights if it.x == x)
    return next(near, NEUTRAL)


# --- the words that choose -----------------------------------------------------------

Choice = Callable[[Record, Model, Sequence[str], DialogueTypes], Sequence[str]]
"""Chooses, in a state, among the things that the rest of a phrase fits."""


def latest_mentioned(s: Record, things: Iterable[str]) -> str | None:
    """The one of the things that was talked about last, if any was."""
    among = set(things)
    return next((str(x) for x in s.shared.salient if x in among), None)


def just_mentioned(s: Record, things: Collection[str]) -> str | None:
    """The one of the things that was just talked about, if one and no other was."""
    mentioned = [str(x) for x in s.shared.topic if x in things]
    return mentioned[0] if len(mentioned) == 1 else None


def talked_about(s: Record) -> Sequence[str]:
    """What was talked about last, or else what is in focus."""
    latest: Sequence[str] = s.shared.salient[:1] or s.view.focus
    return latest


def across(
    s: Record,
    model: Model,
    things: Iterable[str],
    *,
    types: DialogueTypes | None = None,
) -> list[str]:
    """The things from left to right as they are seen.

    The witness function of `across` says how far to the right a thing is; without one
    the order is that of the view.

    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> things = Thing("cup", "red", place=(7, 3)), Thing("book", "red", place=(2, 3))
    >>> game = simulated_game(World(things))
    >>> run = game.take(game.begin(), game.hear("Look!")).run
    >>> across(run.state, run.model, ["o1", "o2"])
    ['o2', 'o1']
    """
    place = (types or packaged_types())["across"]
    order = {str(x): i for i, x in enumerate(s.view.things)}

    def rightness(x: str) -> tuple[float, int]:
        degree = model.facts.perceive(x, place(x, s.view.look))
        return (degree.lo if degree else 0.0), order.get(x, len(order))

    return sorted(things, key=rightness)


def _most_salient(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    """The most salient of the things, and those that nearly are so.

    What is talked about, but not in view, may be more salient: then it is none of them.
    """
    degrees = saliences(s)
    unseen = (x for x in degrees if x not in s.view.things)
    most = max((degrees.get(x, 0.0) for x in (*things, *unseen)), default=0.0)
    least = most - s.private.strategy.salience.margin
    return [x for x in things if degrees.get(x, 0.0) >= least]


def _other(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    latest = latest_mentioned(s, things) or next(iter(s.view.pointed), None)
    return [x for x in things if x != latest]


def _things_without_name(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    """Those of which nobody has said what they are, or else what was not mentioned."""
    here = frozenset(s.shared.here)
    named = {
        str(target["x"].value)
        for it in s.private.lessons
        if it.sign.kind == "noun" and it.content in here and not is_denial(it.content)
        for target in [it.content["target"]]
    }
    if not named:
        return _other(s, model, things, types)
    return [x for x in things if x not in named]


def _nth(n: int) -> Choice:
    def choose_nth(
        s: Record, model: Model, things: Sequence[str], types: DialogueTypes
    ) -> Sequence[str]:
        return across(s, model, things, types=types)[n:][:1]

    return choose_nth


def _any(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    return things


def _flanks(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    """The two things that were talked about last, or else those at both ends."""
    said = [str(x) for x in s.shared.salient if x in things]
    if len(said) > 1:
        return said[:2]
    row = across(s, model, things, types=types)
    return list(dict.fromkeys((*row[:1], *row[-1:])))


def _most(comparative: str) -> Choice:
    def choose_most(
        s: Record, model: Model, things: Sequence[str], types: DialogueTypes
    ) -> Sequence[str]:
        return unexceeded_things(s, model, types[comparative], things)

    return choose_most


def _middle(
    s: Record, model: Model, things: Sequence[str], types: DialogueTypes
) -> Sequence[str]:
    """The middle one of the things, or the two that are next to the middle."""
    row = across(s, model, things, types=types)
    return row[(len(row) - 1) // 2 : len(row) // 2 + 1]


CHOICES: Mapping[str, Choice] = {
    "mentioned": _most_salient,
    "other": _other,
    "remaining": _things_without_name,
    "middle": _middle,
    "any_other": _any,
    "flank": _flanks,
    "leftmost": _nth(0),
    "first": _nth(0),
    "second": _nth(1),
    "third": _nth(2),
    "last": _nth(-1),
    "second_last": _nth(-2),
    "third_last": _nth(-3),
    "rightmost": _nth(-1),
    **{name: _most(comparative) for name, comparative in COMPARATIVES.items()},
}
"""The words that choose, by the names of their predicates."""


def choosing_predicates(types: DialogueTypes) -> frozenset[Pred]:
    """The predicates that choose among the things that fit the rest of a phrase."""
    return frozenset(types[name] for name in CHOICES)


def compares(phrase: RecordType) -> bool:
    """Whether a phrase chooses its thing by a measure: "the biggest one"."""
    field = phrase.get("d")
    parts = field.parts if isinstance(field, Meet) else (field,)
    return any(isinstance(it, PType) and it.pred.name in COMPARATIVES for it in parts)


def choose(
    s: Record, model: Model, pred: Pred, things: Sequence[str], *, types: DialogueTypes
) -> Sequence[str]:
    """Those of the things that the predicate chooses."""
    return CHOICES[pred.name](s, model, things, types)


def needs_salience(content: RecordType, types: DialogueTypes) -> bool:
    """Whether a phrase of a content is about what is most salient, as "it" is."""
    return _has(content, types["mentioned"])


@lru_cache(4096)
def _has(T: TypeNode, pred: Pred) -> bool:
    match T:
        case PType(it, _):
            return it is pred
        case RecordType(fields):
            return any(_has(field, pred) for _, field in fields)
        case Meet(parts):
            return any(_has(part, pred) for part in parts)
    return False
