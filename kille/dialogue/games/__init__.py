"""The games of tutoring, a page each, as update rules over one typed state.

What the tutor says becomes the latest move; its noun phrases are resolved; a game
answers it by putting the type of the robot's next move on the agenda; when the robot
has made that move, it is the latest. Every rule says in its docstring when it applies.
The bands of certainty are numbers in the state, and degrees are those of judgements:
nothing is decided elsewhere.

Source: Dobnik and de Graaf 2017, section 3.
"""

from __future__ import annotations

from kille.dialogue.games.abstaining import ACKNOWLEDGING, EXEMPLIFYING
from kille.dialogue.games.attending import ATTENDED
from kille.dialogue.games.breaking_silence import BREAKING_SILENCE
from kille.dialogue.games.checking import CHECKING
from kille.dialogue.games.clarifying import CLARIFYING, EXCLUDED, MENTIONED
from kille.dialogue.games.colouring import COLOURING
from kille.dialogue.games.comparing import COMPARING, MEASURING
from kille.dialogue.games.confirming import CONFIRMING
from kille.dialogue.games.continuing import CONTINUING
from kille.dialogue.games.contradicting import CONTRADICTING, EARLIER_ANSWERED
from kille.dialogue.games.correcting import CORRECTING
from kille.dialogue.games.counting import COUNTING
from kille.dialogue.games.courtesy import COURTESY
from kille.dialogue.games.criticising import CRITICISING
from kille.dialogue.games.distinguishing import DISTINGUISHING
from kille.dialogue.games.doubting_words import DOUBT_ANSWERED, DOUBTING_WORDS
from kille.dialogue.games.explaining import EXPLAINING
from kille.dialogue.games.finding import FINDING
from kille.dialogue.games.forgetting import (
    FORGET_ANSWERED,
    FORGETTING,
    RETHINKING,
)
from kille.dialogue.games.frame_of_reference import (
    ASKING_FRAME,
    FRAME_ANSWERED,
    FRAME_OF_REFERENCE,
)
from kille.dialogue.games.generalising import GENERALISING
from kille.dialogue.games.holding_floor import HOLDING_FLOOR
from kille.dialogue.games.instructing import INSTRUCTING
from kille.dialogue.games.interrupting import REPEATING, drop_unsaid
from kille.dialogue.games.kinds_of_kinds import KINDS_OF_KINDS, STILL_ANSWERED
from kille.dialogue.games.knowing import KNOWING
from kille.dialogue.games.listening import GLANCED, LISTENING, SAID, SEEN
from kille.dialogue.games.mishearing import MISHEARD
from kille.dialogue.games.misspelling import OFFER_ANSWERED, OFFERING
from kille.dialogue.games.naming import NAMING
from kille.dialogue.games.pairing import PAIR_ANSWERED, PAIRING
from kille.dialogue.games.placing import BETWEEN, PLACING
from kille.dialogue.games.presupposing import PRESUPPOSED, SUPPOSING
from kille.dialogue.games.referring import CHOOSING, MISSING, REFERRING
from kille.dialogue.games.second_noun import BOTH_ANSWERED, SECOND_NOUN
from kille.dialogue.games.several_lessons import LESSONS_ANSWERED, SEVERAL_LESSONS
from kille.dialogue.games.several_things import SEVERAL_THINGS, THINGS_ANSWERED
from kille.dialogue.games.surveying import SURVEYING
from kille.dialogue.games.taking_initiative import IDLING, STAYING, TAKING_INITIATIVE
from ttr.updates import Algorithm, Rule, first, maybe, seq

__all__ = ["TUTORING", "games_with"]

ANSWERING = first(
    CONTRADICTING,
    MEASURING,
    CRITICISING,
    KINDS_OF_KINDS,
    ACKNOWLEDGING,
    CONFIRMING,
    CORRECTING,
    SECOND_NOUN,
    INSTRUCTING,
    SEVERAL_THINGS,
    NAMING,
    PLACING,
    BETWEEN,
    COMPARING,
    SUPPOSING,
    CHECKING,
    COLOURING,
    FINDING,
    SURVEYING,
    COUNTING,
    EXPLAINING,
    PAIRING,
    GENERALISING,
    KNOWING,
    FORGETTING,
    COURTESY,
    ATTENDED,
    MENTIONED,
)
"""What answers a move of the tutor's whose phrases are resolved."""


def games_with(*answers: Rule) -> Algorithm:
    """The games of tutoring, and rules for what no rule of theirs answers.

    >>> from kille.dialogue.rules import reply
    >>> games = games_with(reply("Okay", "Part", "Whoever says OK wants to leave."))
    >>> games == TUTORING, games_with() == TUTORING
    (False, True)
    """
    return first(
        seq(
            LISTENING,
            maybe(first(EXCLUDED, RETHINKING)),
            first(
                REPEATING,
                HOLDING_FLOOR,
                MISHEARD,
                OFFER_ANSWERED,
                LESSONS_ANSWERED,
                DOUBT_ANSWERED,
                FORGET_ANSWERED,
                PAIR_ANSWERED,
                EARLIER_ANSWERED,
                BOTH_ANSWERED,
                STILL_ANSWERED,
                THINGS_ANSWERED,
                FRAME_ANSWERED,
                seq(
                    maybe(CLARIFYING),
                    maybe(first(SEVERAL_LESSONS, DOUBTING_WORDS, CONTINUING, OFFERING)),
                ),
            ),
            maybe(FRAME_OF_REFERENCE),
            maybe(first(CHOOSING, REFERRING, PRESUPPOSED, MISSING)),
            maybe(ASKING_FRAME),
            maybe(first(*ANSWERING.parts, *answers)),
            maybe(EXEMPLIFYING),
            maybe(DISTINGUISHING),
        ),
        SAID,
        GLANCED,
        BREAKING_SILENCE,
        drop_unsaid,
        seq(STAYING, SEEN, maybe(IDLING)),
        seq(SEEN, maybe(TAKING_INITIATIVE)),
    )


TUTORING = games_with()
"""What becomes of every event: heard, said, cut off, glanced at, watched or seen.

>>> from kille.dialogue.games import TUTORING
>>> from ttr.updates import rules_of
>>> len({rule.name for rule in rules_of(TUTORING)}) > 100
True
"""
