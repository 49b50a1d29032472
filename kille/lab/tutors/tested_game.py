"""The games of tutoring in a simulated world, with who plays them: to be tested.

ttr test kille.lab.tutors.tested_game:game
"""

from __future__ import annotations

import re
from functools import cache, lru_cache
from string import Formatter

from hypothesis import strategies as st

from kille.dialogue.language import LANGUAGES
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import DialogueTypes
from kille.lab.tutors.exploring import exploring_tutor
from kille.lab.tutors.heard_sayings import IN_PARTS
from kille.lab.tutors.question_answers import DROPPING, answer_test
from kille.lab.worlds.asides import aside_wordings
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.robot_profiles import ROBOTS
from kille.lab.worlds.worlds import draw_world
from ttr import Model, Record
from ttr.testing import Roles


def words(event: Record) -> str | None:
    """How the tutor worded an event; None for what was not said.

    What is understood in a part only is no event that its words are read as.
    """
    if "text" not in event or _pattern_in_parts().fullmatch(str(event.text)):
        return None
    return str(event.text)


@cache
def _pattern_in_parts() -> re.Pattern[str]:
    """What is said to the robot of which it understands a part only."""
    wordings = {
        wording
        for language in LANGUAGES
        for act in IN_PARTS
        for wording in lexicon(language).tells[act]
    } | {wording for language in LANGUAGES for wording in aside_wordings(language)}
    return re.compile("|".join(map(_pattern_of, sorted(wordings))))


def _pattern_of(wording: str) -> str:
    """A regular expression for what a wording is with anything in its slots."""
    parts = Formatter().parse(wording)
    return "".join(
        re.escape(text) + ("" if slot is None else ".+") for text, slot, _, _ in parts
    )


def roles_in(language: str, types: DialogueTypes | None = None) -> Roles:
    """Where in a state the things are that properties speak of, in a language.

    What is said is read by these types, or else by those of the packaged theory.
    """
    return Roles(
        qud="shared.qud",
        commitments="shared.commitments",
        latest="shared.latest",
        words=words,
        answers=answer_test(language, types),
        drops=DROPPING,
        retracts=frozenset({"keep"}),
        moves=8,  # where each of the things that there are is
    )


game = simulated_game(draw_world(1))
"""The games, in front of a table with four things on it and four beside it."""

tutor = exploring_tutor()
roles = roles_in("en")

WORLDS = 4
"""In how many worlds each robot begins."""

_ENGLISH = [robot for robot in ROBOTS if robot.language == "en"]


@lru_cache(len(_ENGLISH) * WORLDS)
def _start(robot: int, seed: int) -> tuple[Record, Model]:
    """The state and the model in which a dialogue with a robot begins."""
    begun = _ENGLISH[robot].game(seed)
    return begun.start, begun.model


starts = st.builds(_start, st.integers(0, len(_ENGLISH) - 1), st.integers(1, WORLDS))
"""Where dialogues begin: with every robot that speaks English, in some worlds."""
