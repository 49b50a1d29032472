"""Turns that are spoken: what the tutor was perhaps heard to say, and how much of an
answer was uttered before somebody spoke over it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from kille.agent.agent import Agent
from kille.dialogue.language import understand
from kille.dialogue.robust_reading.text_hearing import hear_text
from kille.dialogue.speech_hypotheses import SURE
from kille.speech.expectations import speech
from kille.speech.recognition import Hypothesis

_POINTING = re.compile(r"#\d+")


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
    if is_cut_off(robot, uttered, turns):
        robot.interrupt(" ".join(uttered.split()))
        return True
    robot.do("spoken")
    return False


def is_cut_off(robot: Agent, uttered: str, turns: int) -> bool:
    """Whether this is less than its answer, in a turn after so many."""
    answered = [it.answer for it in robot.exchanges[turns:] if it.said]
    return bool(answered) and len(uttered.split()) < len(answered[-1].split())


def is_understood(robot: Agent, texts: Iterable[str]) -> bool:
    """Whether the robot understands one of these, as a sentence or by its parts.

    To point at things, as in "#2", is understood, too.
    """
    words = [(text, _POINTING.sub(" ", text)) for text in texts]
    return any(
        (text != rest and not rest.strip())
        or any(
            it.readings
            for it in hear_text(
                rest, robot.state, robot.language, types=robot.types
            ).moves
        )
        for text, rest in words
    )
