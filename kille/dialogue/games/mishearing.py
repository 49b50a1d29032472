"""What was not heard well: the robot asks whether it was that, or to hear it again.

Each thing that may have been said is an option of the question. The tutor settles it by
saying yes, or by saying it again.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.beliefs import knows_word
from kille.dialogue.meanings import DialogueTypes, claims, single_claims
from kille.dialogue.moves import issue, plan
from kille.dialogue.rules import rule
from kille.dialogue.speech_hypotheses import (
    FAINTLY,
    SURE,
    WeighedMove,
    is_of_one_text,
    weigh_readings,
)
from kille.dialogue.word_lists import PARTIAL
from ttr import Model, Record, replace
from ttr.updates import NBest, first


@rule(when="State", on="Heard", p=FAINTLY)
def ask_heard(
    s: Record, said: Record, *, nbest: object, model: Model, types: DialogueTypes
) -> Record | None:
    """Two things may have been said, or it hardly was the one: it asks which."""
    if not isinstance(nbest, NBest) or is_of_one_text(nbest):
        return None
    hearing = s.private.strategy.hearing
    heard = weigh_readings(s, model, nbest, types=types)
    clear = _is_clear(s, heard) and not _is_new_word(s, model, heard[0], types=types)
    if clear or heard[0].p < hearing.floor:
        return None
    near = [it.said for it in heard[:2] if heard[0].p - it.p < hearing.ahead]
    act = "AskHeard" if len(near) == 2 else "AskHeardOne"
    signs = tuple(dict.fromkeys(sign for it in near for sign in it.signs))
    contents = [it.content for it in near]
    return plan(
        s,
        act,
        *contents,
        signs=signs,
        asks=[issue("AskHeard", map(_as_asked, near))],
        types=types,
    )


def _as_asked(said: Record) -> Record:
    """The move without the doubt whether it is meant, which a yes now settles."""
    single = len(single_claims(said.content)) == 1
    if "doubt" in said and said.doubt == PARTIAL and single:
        return replace(said, doubt="")
    return said


@rule(when="State", on="Heard", p=FAINTLY)
def beg_pardon(
    s: Record, said: Record, *, nbest: object, model: Model, types: DialogueTypes
) -> Record | None:
    """Nothing that may have been said is likely enough: it asks to hear it again."""
    if not isinstance(nbest, NBest) or is_of_one_text(nbest):
        return None
    if _is_clear(s, weigh_readings(s, model, nbest, types=types)):
        return None
    return plan(s, "Pardon", types=types)


@rule(answers="Deny")
def take_back_heard(s: Record, *, types: DialogueTypes) -> Record | None:
    """It was none of these: the question is dropped, and it asks to hear it again."""
    if not s.shared.qud or s.shared.qud[0].ask != "AskHeard":
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "Pardon", types=types)


def _is_new_word(
    s: Record, model: Model, heard: WeighedMove, *, types: DialogueTypes
) -> bool:
    """Whether what was heard would teach a new word that was not heard that well."""
    said = heard.said
    if heard.p >= SURE or not types.has(said, "Teaching", model):
        return False
    return any(claims(said.content, it) and not knows_word(s, it) for it in said.signs)


def _is_clear(s: Record, heard: Sequence[WeighedMove]) -> bool:
    """Whether the likeliest is likely enough, and far enough ahead of the next."""
    hearing = s.private.strategy.hearing
    following = heard[1].p if len(heard) > 1 else 0.0
    return bool(heard[0].p >= hearing.trust and heard[0].p - following >= hearing.ahead)


MISHEARING = first(ask_heard, beg_pardon)
MISHEARD = take_back_heard
