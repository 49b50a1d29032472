"""Answers to a yes or no that, by the strategy, teaches nothing.

The robot after KILLE (Cano Santin 2019) learned from a yes only what it had not been
sure of, and from a no nothing; and it spoke of how many examples it had been shown.
"""

from __future__ import annotations

from kille.dialogue.beliefs import degree
from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    is_denial,
    predicate_at,
    value_at,
    word_of,
)
from kille.dialogue.moves import change_act, plan
from kille.dialogue.reference import PARTS, thing_at
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, replace
from ttr.types import Negation, PType
from ttr.updates import first


@rule(answers="Affirm")
def acknowledge(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor confirms a claim that the robot was too sure of to learn from it."""
    if len(s.shared.pending) != 1:
        return None
    if _degree(model, s.shared.pending[0]) < s.private.strategy.yes_below:
        return None
    return plan(s, "Acknowledge", types=types)


@rule(answers="Deny")
def only_ask(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor rejects a claim, and the robot only asks what is so."""
    pending = s.shared.pending
    if not pending or _degree(model, pending[0]) < s.private.strategy.no_below:
        return None
    return plan(s, "AskAgain", types=types)


@rule(when="State")
def count_examples(s: Record, *, types: DialogueTypes) -> Record | None:
    """It learns a word: it says if it needs more examples of it."""
    enough = s.private.strategy.examples
    if not enough or not s.private.agenda:
        return None
    planned = s.private.agenda[0]
    if predicate_at(planned, "e").name not in LEARNING:
        return None
    count = _examples(s, value_at(planned, "teaches")[-1])
    few = "LearnedFew" if count < enough else "LearnedMore"
    act = "LearnedEnough" if count == enough else few
    return replace(s, {"private.agenda": (change_act(planned, act, types=types),)})


LEARNING = ("learned", "learned_quality", "learned_relation")
"""What the robot says when it has learned an example."""


def _examples(s: Record, content: RecordType) -> int:
    """How many examples of its word there are with this one, of all dialogues."""
    word = _claim(content).pred
    lessons = (it.content for it in s.private.lessons if not is_denial(it.content))
    before = sum(it.lessons for it in s.private.taught if word_of(it.sign) is word)
    return 1 + sum(_claim(it).pred is word for it in lessons) + int(before)


def _degree(model: Model, content: RecordType) -> float:
    """How probable the claim of a content is."""
    claim = _claim(content)
    things = [x for x in (thing_at(content, it) for it in PARTS) if x is not None]
    front = [value_at(content, "frame")] if "frame" in content else []
    p = degree(model, claim.pred(*things, value_at(content, "look"), *front))
    return 1.0 - p if is_denial(content) else p


def _claim(content: RecordType) -> PType:
    """What a content claims to be true, or not."""
    claim = next(content[label] for label in CLAIMS if label in content)
    claim = claim.body if isinstance(claim, Negation) else claim
    assert isinstance(claim, PType)
    return claim


ACKNOWLEDGING = first(acknowledge, only_ask)
EXEMPLIFYING = count_examples
