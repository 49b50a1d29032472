"""Salience: which of the things in view a word like "it" may be about.

A move with such a word is heard with how salient each thing is at that moment, to the
eye and in the talk: of the things that fit, the most salient is meant, and where two
are nearly as salient the robot asks. A theory that has another rule in the place of
this one weighs what is seen and what is said in its own way.

Source: Kelleher, Costello and van Genabith 2005 (visual and linguistic salience).
"""

from __future__ import annotations

from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.reference.salience import needs_salience, set_salience
from kille.dialogue.rules import reply, rule
from kille.dialogue.speech_hypotheses import FAINTLY
from ttr import Record
from ttr.updates import NBest


@rule(when="State", on="Heard", p=FAINTLY)
def weigh_salience(
    s: Record, said: Record, *, nbest: object, types: DialogueTypes
) -> Record | None:
    """What is heard has a word like "it": how salient things are counts now."""
    heard = (it for it, _ in nbest) if isinstance(nbest, NBest) else (said,)
    needed = any(needs_salience(it.content, types) for it in heard)
    return set_salience(s) if needed else None


ATTENDING = weigh_salience
ATTENDED = reply(
    "Attend", "Noted", "The tutor draws attention to a thing, spoken of from then on."
)
