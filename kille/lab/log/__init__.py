"""The log of a study: all its dialogues in one SQLite file, each written when it ends.

A dialogue is one transaction, so that a kill at any moment leaves it whole or not
there. One program writes at a time; others go on reading. Dialogues are read in the
order of the study, whatever the order in which they ended.
"""

from kille.lab.log.about import About
from kille.lab.log.outcomes import Broken, Finished, Outcome, RunError
from kille.lab.log.reading import (
    about,
    broken_runs,
    count_outcomes,
    find_outcome,
    outcomes,
    read,
    study,
)
from kille.lab.log.tables import write_tables
from kille.lab.log.writing import Log
from ttr.aliases import former_names

__all__ = [
    "About",
    "Broken",
    "Finished",
    "Log",
    "Outcome",
    "RunError",
    "about",
    "broken_runs",
    "find_outcome",
    "outcomes",
    "count_outcomes",
    "read",
    "study",
    "write_tables",
]

__getattr__ = former_names(
    __name__,
    {"broken": "broken_runs", "named": "find_outcome", "over": "count_outcomes"},
)
