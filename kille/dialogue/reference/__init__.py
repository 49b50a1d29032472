"""What noun phrases refer to: the things in view that most probably are of their types.

A phrase means the merge of what its words mean, so to resolve it is to judge the things
in view of one type, and of what it is said to stand beside. What the talk is about is
judged like anything else: `shown` is true of what is in focus, `mentioned` of what was
talked about last, `other` of the rest.

Source: Kennington and Schlangen 2015 (words as classifiers, composed); Kelleher et al.
2005 (salience).
"""

from __future__ import annotations

from kille.dialogue.reference.incremental import meant_by, ranking, said_by
from kille.dialogue.reference.perspectives import (
    AWAY,
    LANDMARK,
    OPEN,
    VIEWER,
    front_of,
    known_front,
)
from kille.dialogue.reference.resolving import (
    PARTS,
    PhraseJudge,
    Reading,
    fits_well,
    fitting_readings,
    in_view,
    intended_readings,
    phrase_at,
    phrases,
    possible_readings,
    thing_at,
    things_in,
)
from kille.dialogue.reference.salience import across
from ttr.aliases import former_names

__getattr__ = former_names(
    __name__,
    {
        "Judging": "PhraseJudge",
        "contents": "possible_readings",
        "denoted": "intended_readings",
        "facing": "known_front",
        "fitting": "fitting_readings",
    },
)

__all__ = [
    "AWAY",
    "LANDMARK",
    "OPEN",
    "PARTS",
    "VIEWER",
    "PhraseJudge",
    "Reading",
    "across",
    "possible_readings",
    "intended_readings",
    "known_front",
    "fits_well",
    "fitting_readings",
    "front_of",
    "in_view",
    "meant_by",
    "phrase_at",
    "phrases",
    "ranking",
    "said_by",
    "thing_at",
    "things_in",
]
