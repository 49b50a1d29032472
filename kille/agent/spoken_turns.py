"""Turns that are spoken: what the tutor was perhaps heard to say, and how much of an
answer was uttered before somebody spoke over it."""

from __future__ import annotations

from collections.abc import Sequence

from kille.agent.agent import Agent
from kille.dialogue.language import understand
from kille.dialogue.reading_weights import SURE
from kille.speech.expectations import speech
from kille.speech.recognition import Hypothesis


def answer_hypotheses(
    robot: Agent, heard: Sequence[Hypothesis], language: str = "en"
) -> str:
    """The robot's answer to what was perhaps said; it begs pardon for a noise.

    Of several moves in one utterance the likeliest text counts. Of a single move all
    hypotheses go into the dialogue, which weighs them with what is seen. Where none is
    a sentence of the grammar, all are read by their parts.
    """
    if not heard:
        return speech(language).sorry
    understood = [
        (it, len(understand(it.text, language, types=robot.types)))
        for it in heard
        if all(
            sentence.readings
            for sentence in understand(it.text, language, types=robot.types)
        )
    ]
    if not understood:
        sure = [it.text for it in heard if it.p >= SURE]
        return robot.hear(sure[0]) if sure else robot.hear_perhaps(*heard)
    (likeliest, moves), *_ = understood
    if likeliest.p >= SURE or moves > 1:
        return robot.hear(likeliest.text)
    return robot.hear_perhaps(*(it for it, moves in understood if moves == 1))


def tell_uttered(robot: Agent, uttered: str, turns: int) -> bool:
    """Tell the robot what of its answer was uttered, in a turn after so many.

    Returns whether it was cut off.
    """
    answered = [it.answer for it in robot.exchanges[turns:] if it.said]
    spoken = uttered.split()
    if not answered or len(spoken) >= len(answered[-1].split()):
        robot.do("spoken")
        return False
    robot.interrupt(" ".join(spoken))
    return True
