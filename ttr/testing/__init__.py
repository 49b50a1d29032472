"""Property tests of update rules: `check_rules` plays thousands of dialogues.

Rules are tested by properties that any dialogue theory should have, P1 to P27, on
dialogues with a tutor who looks at the state. A failure is reported with the shortest
dialogue that shows it, as a story that reproduces it. Read `suites` and
`properties` first; `search` and `shrinking` find the dialogue, `strategies` draws it.
This room may use all others except `cli`.

>>> for one in sorted(ALL, key=lambda one: int(one.name[1:]))[:3]:
...     print(one.name, one.says)
P1 after every rule the state is of its type, and of what the rule promises.
P2 a rule never changes the state that it is given, whether it applies or not.
P3 the same events lead to the same states by the same rules.
"""

from __future__ import annotations

try:
    import hypothesis  # noqa: F401
except ImportError as missing:
    raise ImportError(
        "ttr.testing needs hypothesis: pip install 'kille[test]'"
    ) from missing

from ttr.dialogues.dialogue import Dialogue, Trial, play
from ttr.testing.coverage import Coverage
from ttr.testing.hypothesis_state_machines import machine
from ttr.testing.properties.catalogue import ALL
from ttr.testing.properties.property import Breach, Property
from ttr.testing.pytest_decorator import on_dialogues
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.tutors import Tutor
from ttr.testing.suites import Report, Suite, check_rule, check_rules

__all__ = [
    "ALL",
    "Breach",
    "Coverage",
    "Dialogue",
    "Trial",
    "Property",
    "Report",
    "Roles",
    "Suite",
    "Tutor",
    "check_rule",
    "check_rules",
    "machine",
    "on_dialogues",
    "play",
]
