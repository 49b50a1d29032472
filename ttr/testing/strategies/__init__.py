"""Hypothesis strategies for property tests: types, records, models, states, dialogues.

They draw from few names, so that clashes happen, and reach every constructor: ptypes of
several arities, record types with dependent, manifest and nested fields, paths outwards
and circles, functions, lists, sets, strings, and what is computed from them. What they
draw is well-formed and shrinks to what is small. Dialogues are drawn by a tutor who
looks at the state before saying anything.

>>> from hypothesis import given, settings
>>> from ttr import subtype
>>> @settings(max_examples=10, database=None)
... @given(types())
... def subtyping_is_reflexive(T):
...     assert subtype(T, T).yes
>>> subtyping_is_reflexive()
"""

from __future__ import annotations

try:
    import hypothesis  # noqa: F401
except ImportError as missing:
    raise ImportError(
        "ttr.testing.strategies needs hypothesis: pip install 'kille[test]'"
    ) from missing

from ttr.dialogues.dialogue import Dialogue, Trial, play
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.random_dialogues import dialogues
from ttr.testing.strategies.random_models import models
from ttr.testing.strategies.random_records import records
from ttr.testing.strategies.random_states import events, states
from ttr.testing.strategies.random_terms import objects, record_types, types
from ttr.testing.strategies.tutors import Tutor

__all__ = [
    "Dialogue",
    "Trial",
    "Roles",
    "Tutor",
    "dialogues",
    "events",
    "models",
    "objects",
    "play",
    "record_types",
    "records",
    "states",
    "types",
]
