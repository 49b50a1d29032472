"""Which islands of a cover may stand beside the others, and what it leaves out.

An island is read as if it had been said alone. Beside other words it may be none of the
moves that it could be: a "yes" that answers nothing, or orders to forget with a "not".
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from typing import NamedTuple

from kille.dialogue.parsing import parts
from kille.dialogue.robust_reading.clause_words import Word, are_harmless
from kille.dialogue.robust_reading.island_covers import Cover
from kille.dialogue.robust_reading.island_kinds import (
    ABOUT_KINDS,
    CLAIMS,
    CORRECTABLE,
    ELLIPTIC,
    FALLBACK,
    FOLLOWS,
    GAPPED,
    SINGLE,
)
from kille.dialogue.robust_reading.islands import Island
from kille.dialogue.robust_reading.lessons_together import MOST
from kille.dialogue.robust_reading.self_repairs import RepairedSentence
from kille.dialogue.robust_reading.situations import Situation

WHOLE = frozenset(
    {
        "affirm",
        "deny",
        "okay",
        "ask_repeat",
        "ask_help",
        "leave",
        "alone",
        "release_floor",
    }
)
"""The moves beside which nothing of their clause may be left out."""

STRICT = frozenset(
    {
        "mention",
        "take_frame",
        "about",
        "about_where",
        "ask_repeat",
        "forget_that",
        "forget_last",
        "forget_all",
        "reject_several",
        "forget_word",
        "orient",
    }
)
"""The moves beside which nothing of the sentence may be left out."""

ANYWHERE = frozenset(
    {"greet", "thank", "okay", "affirm", "deny", "mention", "take_frame"}
)
"""The moves other than claims that need not begin a clause."""

COURTESY = frozenset({"greet", "thank", "leave", "okay", "affirm", "deny"})
"""The moves after which another may begin."""

OVER_BREAKS = frozenset(
    {"correct", "reject", "named", "also_named", "meant", "turned", "other_place"}
)
"""The claims that may go on after a comma: "It is not a cup, it is a mug"."""

TAKES_UP = CORRECTABLE | {"correct_thing"}
"""What says a no that stands before it: "No, not that one, I meant the can."."""

UNSOUND = 0.05
"""The factor for an island that cannot be taken as what it could be alone."""

LONGEST_NAME = 3
"""How many words a name alone has at most."""

LONGEST_ASIDE = 8
"""How many words may stand after a name alone; before it, no more than it may have."""


def keep_admissible(
    cover: Cover, sentence: RepairedSentence, situation: Situation
) -> Cover:
    """The cover without islands that may not stand in it as they do: those it misses.

    A yes that answers nothing, and what is said again, is not missed.
    """
    for n, island in enumerate(cover.islands):
        if _may_stand(_Place.of(island, cover, sentence), situation):
            continue
        inside = sentence.words[island.first : island.after]
        again = any(it.rule == island.rule for it in cover.islands[:n])
        idle = island.rule == "affirm" or (again and island.rule in STRICT)
        gone = () if idle else tuple(it for it in inside if not it.is_harmless)
        less = Cover(
            (*cover.islands[:n], *cover.islands[n + 1 :]),
            tuple(sorted((*cover.missed, *gone))),
            cover.weight * UNSOUND,
        )
        return keep_admissible(less, sentence, situation)
    return cover


class _Place(NamedTuple):
    """Where an island stands: its words, and what is around them."""

    island: Island
    cover: Cover
    sentence: RepairedSentence
    inside: Sequence[Word]
    near: Sequence[Word]
    """The words of its clauses that are left out."""
    earlier: Sequence[Island]
    other_claims: Sequence[Island]

    @classmethod
    def of(cls, island: Island, cover: Cover, sentence: RepairedSentence) -> _Place:
        """The place of an island of a cover."""
        words = sentence.words
        return cls(
            island,
            cover,
            sentence,
            inside=words[island.first : island.after],
            near=cover.missed_near(island, words),
            earlier=cover.before(island),
            other_claims=[
                it for it in cover.islands if it != island and it.rule in CLAIMS
            ],
        )

    @property
    def begins(self) -> bool:
        """Whether only harmless words stand before it."""
        return are_harmless(self.sentence.words[: self.island.first])

    @property
    def ends(self) -> bool:
        """Whether only harmless words stand after it."""
        return are_harmless(self.sentence.words[self.island.after :])

    @property
    def is_only(self) -> bool:
        """Whether it is the only island."""
        return len(self.cover.islands) == 1

    @property
    def follows_missed(self) -> bool:
        """Whether some word before it is left out."""
        return any(it < self.inside[0] for it in self.cover.missed)

    @property
    def spans_break(self) -> bool:
        """Whether it goes on after a comma."""
        return self.inside[-1].clause > self.inside[0].clause


def _may_stand(place: _Place, situation: Situation) -> bool:
    """Whether an island may be taken as the move that it would be alone."""
    if not _leaves_enough(place):
        return False
    settled = _may_act_stand(place, situation)
    if settled is not None:
        return settled
    return _may_clause_stand(place)


def _leaves_enough(place: _Place) -> bool:
    """Whether an island of its kind may stand beside what is left out, and others."""
    rule, cover = place.island.rule, place.cover
    if rule in FALLBACK and not place.is_only:
        return False
    if rule in ABOUT_KINDS and place.near:
        return False  # "Not all mugs are cups."
    if (rule in STRICT and cover.missed) or (rule in WHOLE and place.near):
        return False
    if rule.startswith("forget_") and _runs_on(place):
        return False  # "Forget that it is made of wood."
    if place.inside[-1].joins:
        return False
    if rule in STRICT and any(it.rule == rule for it in place.earlier):
        return False
    return rule not in SINGLE or (place.is_only and not cover.missed)


def _may_act_stand(place: _Place, situation: Situation) -> bool | None:
    """Whether a move of its kind may stand so; None where its clause decides."""
    island, cover, sentence = place.island, place.cover, place.sentence
    match island.rule:
        case "mention":
            return situation.asks_which
        case "correct_thing" if any(it.rule in CLAIMS for it in place.earlier):
            return False  # "They are all cups, but not the left one."
        case "presumed":
            seen = situation.things == 1 and not sentence.is_question
            return place.begins and seen
        case "greet" if not _begins_clause(place):
            return False  # "I drink it every morning."
        case "ask_repeat" if not place.is_only:
            return False
        case "other_place" if cover.missed or not situation.asks_whether:
            return False
        case "instruct_several" if place.earlier[-1:] and (
            place.earlier[-1].rule in ABOUT_KINDS
        ):
            return False  # "Mugs aren't bowls, they are cups."
        case "instruct_several" if not _are_as_many(place, situation):
            return False
        case "instruct_several" | "instruct_every" | "reject_several" if not (
            _begins_clause(place)
        ):
            return False  # "How many of them are blue"
        case "affirm" | "deny":
            return _may_answer_stand(place, situation)
        case rule if rule in ELLIPTIC:
            return bool(place.earlier) and place.earlier[-1].rule in FOLLOWS[rule]
        case rule if rule in GAPPED:
            return bool(place.other_claims)
        case "alone" if not _may_name_stand(place, situation):
            return False
        case "reject" if island.is_bare and place.spans_break:
            return False
        case "instruct" if island.is_bare and not all(
            it.is_bare for it in place.other_claims
        ):
            return False
        case "instruct" | "alone" if island.is_bare and (
            _is_subject(place) or _is_of_robot(place)
        ):
            return False
        case "correct" if _is_contrast(island) and not (place.begins and place.ends):
            return False
        case "ask_deed" if place.follows_missed:
            return False
        case rule if rule.startswith("ask_") and len(place.near) > len(place.inside):
            return False
    return None


def _is_contrast(island: Island) -> bool:
    """Whether a correction only opposes two bare words: "whistle, not thistle"."""
    found = [it.rule for it in parts(parts(island.trees[0])[0])]
    return found in (["naming", "denied"], ["having", "denied"])


def _is_subject(place: _Place) -> bool:
    """Whether a verb follows in the same clause: "a real bear would eat you"."""
    after = [it for it in place.near if it > place.inside[-1]]
    return any(it.is_auxiliary for it in after)


def _is_of_robot(place: _Place) -> bool:
    """Whether it says what the robot is: "you are a gem"."""
    before = [it for it in place.near if it < place.inside[0]]
    return any(it.is_of_robot for it in before)


def _begins_clause(place: _Place) -> bool:
    """Whether only what is harmless, or joins, stands before it in its clause."""
    clause, before = place.inside[0].clause, place.sentence.words[: place.island.first]
    return all(it.is_harmless or it.joins or it.clause < clause for it in before)


def _are_as_many(place: _Place, situation: Situation) -> bool:
    """Whether as many things are in view as is said, if it is: "these two"."""
    several = dict(zip(place.sentence.numbers[1:], count(2), strict=False))
    said = [several[it.form] for it in place.inside if it.form in several]
    return all(it == situation.things for it in said)


def _may_answer_stand(place: _Place, situation: Situation) -> bool | None:
    """Whether a yes or no may be one; None where its clause decides."""
    is_no, is_question = place.island.rule == "deny", place.sentence.is_question
    if is_no and _runs_on(place):
        return False  # "No, it is not a can."
    if is_no and is_taken_up(place.island, place.cover) and not is_question:
        return place.begins
    if place.other_claims or is_question:
        return False
    if any(it.phrase > len(place.inside) for it in place.inside):
        return False  # "No problem."
    if is_no and any(it.rule == "okay" for it in place.cover.islands):
        return False
    if place.cover.missed:
        return situation.asks_whether and place.begins
    return None


def _runs_on(place: _Place) -> bool:
    """Whether the next island goes on in the same clause, without any word between."""
    words, after = place.sentence.words, place.island.after
    following = any(it.first == after for it in place.cover.islands)
    return following and words[after].clause == place.inside[-1].clause


def _may_name_stand(place: _Place, situation: Situation) -> bool:
    """Whether what might be a name alone may be one."""
    inside, cover = place.inside, place.cover
    if any(it.is_harmless for it in inside) or len(inside) > LONGEST_NAME:
        return False
    babbles = len({it.form for it in inside}) < len(inside)
    far = not place.follows_missed or situation.asks_name
    aside = LONGEST_ASIDE if far else LONGEST_NAME
    if place.sentence.is_question or babbles or len(cover.missed) > aside:
        return False
    others = [it for it in place.other_claims if it.rule != "also_named"]
    return not others or is_list_of_names(cover, place.sentence)


def _may_clause_stand(place: _Place) -> bool:
    """Whether an island stands where a move may: mostly, it begins a clause."""
    island, rule, words = place.island, place.island.rule, place.sentence.words
    is_claim = rule in CLAIMS
    if is_claim and rule not in OVER_BREAKS and place.spans_break:
        return False
    bare = rule == "alone" or (island.is_bare and rule != "named")
    if is_claim and bare and place.sentence.is_question and place.ends:
        return False
    courteous = [it for it in place.cover.islands if it.rule in COURTESY]
    polite = {at for it in courteous for at in range(it.first, it.after)}
    begins = all(
        it.is_harmless or it.clause < place.inside[0].clause or at in polite
        for at, it in enumerate(words[: island.first])
    )
    return begins or rule in ANYWHERE or is_claim


def follows_no(island: Island, cover: Cover) -> bool:
    """Whether a lesson comes right after a no of the same sentence: it corrects."""
    before = cover.before(island)
    return bool(before) and before[-1].rule == "deny" and island.rule in CORRECTABLE


def is_taken_up(island: Island, cover: Cover) -> bool:
    """Whether an island is a no that is said by the correction after it."""
    after = [it.rule for it in cover.after(island)[:1]]
    return island.rule == "deny" and not TAKES_UP.isdisjoint(after)


def is_list_of_names(cover: Cover, sentence: RepairedSentence) -> bool:
    """Whether all that is said are a few names: "pen, pencil"."""
    clauses = {sentence.words[it.first].clause for it in cover.islands}
    alone = all(it.rule == "alone" for it in cover.islands)
    return alone and not cover.missed and len(clauses) == len(cover.islands) <= MOST
