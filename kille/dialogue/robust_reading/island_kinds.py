"""The kinds of islands that are treated alike, by the names of their rules."""

from __future__ import annotations

from kille.dialogue.language import LESSONS

FALLBACK = frozenset({"remark", "other_deed", "presumed"})
"""What is taken so only where nothing else is understood."""

SINGLE = frozenset({"placed", "identity", "quality_alone", "denied_word"})
"""The claims that have to be all that is said."""

INDIRECT = frozenset(
    {
        "named",
        "also_named",
        "sided",
        "alone",
        "presumed",
        "meant",
        "meant_so",
        "placed",
        "identity",
        "quality_alone",
        "side_named",
    }
)
"""The claims that are always asked about."""

ELLIPTIC = frozenset({"is_not", "is_too", "and_how", "kind_too", "kinds_too"})
"""The claims that say of another thing what was just said: "the right one isn't".

Or of the same thing something else, "and soft", or of its kind: "i.e. a kind of cup".
"""

GAPPED = frozenset({"gapped", "sided"})
"""The claims of which one has to stand beside another: "Mug left, cup right"."""

_FULL = frozenset({"instruct", "describe", "correct", "reject", *GAPPED})
"""The claims of which another may be left out in part."""

FOLLOWS = {
    "is_not": _FULL | ELLIPTIC,
    "is_too": _FULL | ELLIPTIC,
    "and_how": frozenset({"describe", "and_how"}),
    "kind_too": frozenset(
        {"instruct", "correct", "named", "also_named", "alone", "classify"}
    ),
    "kinds_too": frozenset({"classify", "unclassify", "kinds_too"}),
}
"""After which claims, and nothing else, the elliptic ones may stand."""

CLAIMS = frozenset(
    (
        *LESSONS,
        "relate",
        "turned",
        "other_place",
        "denied_word",
        *INDIRECT,
        *ELLIPTIC,
        *GAPPED,
    )
)
"""The moves that say how things are."""

ABOUT_KINDS = frozenset({"classify", "equate", "unclassify", "kind_too", "kinds_too"})
"""The claims about kinds: of a noun that it does not know the robot asks anyway."""

CORRECTED = {"instruct": "correct", "describe": "correct", "relate": "correct"}
"""What a lesson is after a no: "Far from it, that's a lamp."."""

CORRECTABLE = frozenset({*CORRECTED, "named", "also_named", "alone", "quality_alone"})
"""The islands that correct where they come after a no."""

ALONE = 0.2
"""How much less a name alone counts than what says of a thing that it is called so."""
