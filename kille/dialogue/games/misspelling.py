"""A word that nearly is a known one: the robot offers that, and takes nothing silently.

"This is a cupp." may be a slip of the hand, or a new word. The robot asks "Do you mean
a cup?": yes takes the move as if it had been said with that word, no takes it as it was
said, and so a new word is learned. Anything else drops the question.
"""

from __future__ import annotations

from kille.dialogue.beliefs import knows, knows_word
from kille.dialogue.commitments import kind_of
from kille.dialogue.games.doubting_words import as_naming
from kille.dialogue.meanings import DialogueTypes, claims, replace_word, word_of
from kille.dialogue.moves import content_of, issue, plan
from kille.dialogue.reference import in_view
from kille.dialogue.rules import rule
from kille.dialogue.typos import is_slip, slip
from ttr import Model, Record, replace
from ttr.updates import first

OFFER = "OfferWord"
"""The question whether a known word was meant; its options are yes and no, in order."""


@rule(answers="Heard")
def offer_word(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """A word is not known, but nearly is one that is: was that meant?"""
    said = s.shared.latest
    for sign in said.signs:
        known = _intended_word(s, model, sign, types=types)
        if known is None or knows(said.signs, known):
            continue  # "Whistle, not thistle."
        seen = replace(said, content=in_view(s, said.content, types=types))
        options = [_with(seen, sign, known), seen]
        asks = [issue(OFFER, options)]
        return plan(s, OFFER, known.meaning, signs=[known], asks=asks, types=types)
    return None


@rule(answers="Intended")
def offer_common_word(
    s: Record, *, model: Model, types: DialogueTypes
) -> tuple[Record, Model] | None:
    """A new word nearly is a common one that was never taught: is that meant?"""
    said = s.shared.latest
    sign = next((it for it in said.signs if claims(said.content, it)), None)
    if sign is None or knows_word(s, sign) or not s.view.things:
        return None
    [common] = said.intended
    seen = replace(said, content=in_view(s, said.content, types=types))
    if common.kind == sign.kind:
        options = [_with(seen, sign, common), seen]
    else:
        meant, model = as_naming(seen, sign, common, model, types=types)
        options = [meant]
    asks = [issue(OFFER, options)]
    asked = plan(
        s,
        OFFER,
        common.meaning,
        signs=[common],
        pending=s.shared.pending,
        asks=asks,
        types=types,
    )
    return asked, model


@rule(answers="Affirm")
def take_offered(s: Record) -> Record | None:
    """The tutor meant the known word: that is what was said."""
    return _choose_option(s, 0) if _is_offered(s) else None


@rule(answers="Deny")
def take_as_said(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor meant the new word: it was said as it was.

    Nothing is learned where it hardly is one, as in "That's acap.".
    """
    if not _is_offered(s):
        return None
    if len(s.shared.qud[0].options) == 1:
        left = replace(s, {"shared.qud": s.shared.qud[1:]})
        return plan(left, "LetBe", types=types)
    return _choose_option(s, 1)


def _intended_word(
    s: Record, model: Model, sign: Record, *, types: DialogueTypes
) -> Record | None:
    """The one known word that a word may be a slip of, if it is not known itself.

    A word that is taught is more likely new, so there only the surest slips count.
    """
    known = s.private[f"{sign.kind}s"]
    if knows(known, sign) or word_of(sign) in model.facts.functions:
        return None
    said = s.shared.latest
    taught = claims(said.content, sign) and types.has(said, "Teaching", model)
    near = is_slip if taught else slip
    found = [it for it in known if near(sign.form, it.form)]
    return found[0] if len(found) == 1 else None


@rule(answers=("ForgetThat", "ForgetLast"))
def drop_offered(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor takes back what has not been learned yet: neither word is."""
    if not _is_offered(s) or kind_of(content_of(s)) is not None:
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "LetBe", types=types)


def _with(said: Record, sign: Record, known: Record) -> Record:
    """A move with one word in place of another."""
    signs = [known if it == sign else it for it in said.signs]
    return replace(said, content=replace_word(said.content, sign, known), signs=signs)


def _is_offered(s: Record) -> bool:
    """Whether the question under discussion is whether a word was meant."""
    return bool(s.shared.qud) and s.shared.qud[0].ask == OFFER


def _choose_option(s: Record, chosen: int) -> Record:
    """The state in which the tutor's move is the option that they chose."""
    asked, *rest = s.shared.qud
    return replace(s, {"shared.qud": rest, "shared.latest": asked.options[chosen]})


OFFERING = first(offer_word, offer_common_word)
"""What asks whether a word was meant that nearly is the one that was said."""

OFFER_ANSWERED = first(take_offered, take_as_said, drop_offered)
