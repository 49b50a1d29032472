"""What noun phrases refer to: the things in view that most probably are of their types.

A phrase means the merge of what its words mean, so to resolve it is to judge the things
in view of one type, and of what it is said to stand beside. What the talk is about is
judged like anything else: `shown` is true of what is in focus, `distal` of what is told
from it. Other words choose among what fits: `mentioned` what is most salient, `other`
what was not talked about last.

| room | holds |
| --- | --- |
| `parts` | a phrase taken apart into the claims that it makes |
| `perspectives` | whose left it is |
| `salience` | how salient things are, and the words that choose among things |
| `demonstratives` | what "this" and "that" may be |
| `resolving` | the phrases of a whole move, set to things |
| `incremental` | a phrase while it is being said, word by word |

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
    roles_in,
    thing_at,
    things_in,
)
from kille.dialogue.reference.salience import (
    ThingSalience,
    across,
    combined_salience,
    saliences,
    set_salience,
    thing_saliences,
)
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
    "ThingSalience",
    "across",
    "combined_salience",
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
    "roles_in",
    "said_by",
    "saliences",
    "set_salience",
    "thing_at",
    "thing_saliences",
    "things_in",
]
