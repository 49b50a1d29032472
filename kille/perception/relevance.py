"""Which cues count for a word, by what a tutor says of them.

Cues are spoken of in groups: who says that the colour does not matter means every cue
that measures it. For each word the weights w_c of the kernels (`likeness`) are changed
by what was said of their groups, the latest word on each of them counting:

- cues that *do not matter* have the weight 0;
- cues that *matter* have together at least as much weight as all the others.

The weights are divided by their sum wherever things are compared, so that the shares of
the groups sum to 1 as they did before. The votes of features are a group as well, the
details: they do not count where these do not matter, by a quarter where other cues are
what matters, and twice where they are. Metric size rejects nothing where the size
does not matter.

What is said of a word changes that word only: its regression is one of its own, against
the same examples. And it follows from the lessons as they stand: where they are taken
back, the word is judged as before.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from kille.perception.likeness import Kernel

DETAILS = "details"
"""The group of the features, which vote."""

GROUPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "colour": ("colour", "hue", "paint", "whole_paint"),
        "shape": ("shape", "outline", "form", "whole_form"),
        "size": ("size",),
        "texture": ("texture", "whole_texture"),
        "pattern": ("pattern", "whole_pattern"),
        DETAILS: ("features",),
    }
)
"""The cues of each group that can be spoken of."""

OTHERS_MATTER, DETAILS_MATTER = 0.25, 2.0
"""What the votes of features count for where cues are what matters, or they are."""


@dataclass(frozen=True)
class Relevance:
    """The groups of cues that matter most for a word, and those that do not matter.

    >>> kernels = {cue: Kernel(1.0, 1.0) for cue in ("hue", "size", "form", "outline")}
    >>> Relevance.of([("shape", True), ("colour", False)]).shares(kernels)
    {'colour': 0.0, 'shape': 0.6666666666666666, 'size': 0.3333333333333333}
    >>> Relevance.of([("size", True)]).shares(kernels)
    {'colour': 0.16666666666666666, 'shape': 0.3333333333333333, 'size': 0.5}
    """

    matter: frozenset[str] = frozenset()
    ignored: frozenset[str] = frozenset()

    @classmethod
    def of(cls, said: Iterable[tuple[str, bool]]) -> Relevance:
        """What was said of groups, in order: whether each of them matters."""
        latest = dict(said)
        return cls(
            frozenset(group for group, matters in latest.items() if matters),
            frozenset(group for group, matters in latest.items() if not matters),
        )

    def ignores(self, cue: str) -> bool:
        """Whether the cue was said not to matter."""
        return any(cue in GROUPS.get(group, ()) for group in self.ignored)

    def kernels(self, kernels: Mapping[str, Kernel]) -> Mapping[str, Kernel]:
        """The kernels with the weights that these cues have for the word."""
        weights = {
            cue: 0.0 if self.ignores(cue) else it.weight for cue, it in kernels.items()
        }
        chief = {cue for group in self.matter for cue in GROUPS.get(group, ())}
        own = sum(weight for cue, weight in weights.items() if cue in chief)
        rest = sum(weights.values()) - own
        more = max(1.0, rest / own) if own else 1.0
        return {
            cue: replace(it, weight=weights[cue] * (more if cue in chief else 1.0))
            for cue, it in kernels.items()
        }

    def shares(self, kernels: Mapping[str, Kernel]) -> dict[str, float]:
        """The share of each group in the weights; they sum to 1, if any is left."""
        weighed = self.kernels(kernels)
        whole = sum(it.weight for it in weighed.values()) or 1.0
        return {
            group: sum(weighed[it].weight for it in cues if it in weighed) / whole
            for group, cues in GROUPS.items()
            if any(cue in weighed for cue in cues)
        }

    @property
    def votes(self) -> float:
        """By how much the votes of features are multiplied."""
        if DETAILS in self.ignored:
            return 0.0
        if DETAILS in self.matter:
            return DETAILS_MATTER
        return OTHERS_MATTER if self.matter else 1.0
