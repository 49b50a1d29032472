"""Reasons as pictures: what the robot sees, beside the lesson that reminds it of."""

from __future__ import annotations

from kille.agent.exchanges import RobotSentence
from kille.dialogue.answer_details import cue_shares
from kille.dialogue.lexicon import Lexicon
from kille.dialogue.meanings import value_at
from kille.dialogue.reference import thing_at
from kille.grounding.witness_functions import WitnessFunctions
from kille.memory import Memory
from kille.memory.pictures import Picture
from kille.perception.comparison_picture import Side, comparison_picture, side_of
from kille.perception.features import features_of
from kille.perception.shown_looks import Picture as ShownPicture
from kille.perception.thumbnails import decode_picture, restore_crop
from kille.scene import Percept
from ttr import Record, RecordType

_SHOWN_WIDTH = 640
"""How wide a reason stands in a notebook, where there is room: pixels of the page."""


def reason_picture(
    said: RobotSentence, seen: WitnessFunctions, memory: Memory, lexicon: Lexicon
) -> ShownPicture | None:
    """The reason that a sentence gives, as a picture without a ground of its own.

    None if it gives none for which there is anything to show. Raises ValueError if the
    picture of the lesson cannot be decoded.
    """
    if said.judgement is None or not said.judgement.sit.reasons:
        return None
    reason = said.judgement.sit.reasons[0]
    sides = [it for it in (_now(reason, seen), _then(reason, memory)) if it is not None]
    if not sides:
        return None
    pixels = comparison_picture(said.text, cue_shares(lexicon, reason), *sides)
    return ShownPicture(pixels, f"a reason: {said.text}", _SHOWN_WIDTH)


def _now(reason: Record, seen: WitnessFunctions) -> Side | None:
    """What the claim is about, as it was seen when the claim was made."""
    claim: RecordType = reason.claim
    look = str(value_at(claim, "look"))
    percepts = [
        percept
        for label in ("target", "landmark")
        if (percept := _percept_at(claim, label, look, seen)) is not None
    ]
    if not percepts:
        return None
    first, frame = percepts[0], percepts[0].frame
    if frame is None:
        return None
    if "rel" in claim:
        return Side(frame.colour, boxes=tuple(it.region.box for it in percepts))
    return side_of(frame, first.region, first.scans[0])


def _percept_at(
    claim: RecordType, label: str, look: str, seen: WitnessFunctions
) -> Percept | None:
    x = thing_at(claim, label) if label in claim else None
    return None if x is None else seen.percept(x, look)


def _then(reason: Record, memory: Memory) -> Side | None:
    """What the lesson showed that the robot is reminded of, if its picture is kept."""
    keys = [int(it.key) for it in reason.reminders]
    picture = memory.picture(keys[0]) if keys else None
    return None if picture is None else _side_of_lesson(picture)


def _side_of_lesson(picture: Picture) -> Side:
    if picture.crop is None:
        return Side(decode_picture(picture.frame), boxes=picture.boxes)
    frame, region = restore_crop(picture.crop)
    return side_of(frame, region, features_of(frame, region))
