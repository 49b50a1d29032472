"""Does a sentence follow from others? Yes, no, or unknown; and never wrongly yes or no.

Sentences say how many things there are in the regions that their properties divide the
world into. The hypothesis follows if no numbers of things make the premises true and
the hypothesis not; it is refuted if none make it true with them. What cannot be taken
apart, as "wants to sing", is a region of its own, so nothing is proved that does not
hold; but what depends on more than the regions may stay unknown.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from ttr.errors import Unsupported
from ttr.safety.budgets import within_budget
from ttr.semantics.argument_checks import as_tuple
from ttr.semantics.fragment.formulas import Formula, Neither, claim
from ttr.semantics.fragment.integer_feasibility import UndecidedError
from ttr.semantics.fragment.lexicon import Lexicon, lexicon_of
from ttr.semantics.fragment.sentences import Sentence, understand
from ttr.semantics.fragment.venn_regions import Regions, World
from ttr.semantics.quantifiers.thresholds import Thresholds, thresholds_of

__all__ = ["Inference", "Verdict", "follows"]

Verdict: TypeAlias = Literal["yes", "no", "unknown"]


@dataclass(frozen=True)
class Inference:
    """An answer, with what it rests on: for unknown, a world each way."""

    verdict: Verdict
    why: str

    def __str__(self) -> str:
        return f"{self.verdict}: {self.why}"


@within_budget
def follows(
    premises: Iterable[str | Sentence],
    hypothesis: str | Sentence,
    words: Lexicon | None = None,
    thresholds: Thresholds | None = None,
) -> Inference:
    """Whether a sentence follows from others, for an agent with these thresholds.

    Raises `OutsideFragment` for a sentence that cannot be read.

    >>> print(follows(["Every dog barks.", "Fido is a dog."], "Fido barks.").verdict)
    yes
    >>> print(follows(["No dog barks."], "Some dog barks.").verdict)
    no
    >>> print(follows(["Some dog barks."], "Every dog barks.").verdict)
    unknown
    """
    premises = as_tuple(premises, "sentences as premises")
    chosen, agent = lexicon_of(words), thresholds_of(thresholds)
    given = [_claim(one, chosen, agent) for one in premises]
    wanted = _claim(hypothesis, chosen, agent)
    try:
        return _answer(given, wanted, Regions(chosen, agent))
    except (UndecidedError, Unsupported) as error:
        return Inference("unknown", str(error) or "it takes too many steps")


def _claim(one: str | Sentence, words: Lexicon, thresholds: Thresholds) -> Formula:
    sentence = one if isinstance(one, Sentence) else understand(one, words)
    return claim(sentence.content, thresholds)


def _answer(given: list[Formula], wanted: Formula, regions: Regions) -> Inference:
    so = regions.world([*given, wanted])
    not_so = regions.world([*given, Neither(wanted)])
    if so is None and not_so is None:
        return Inference("unknown", "the premises contradict each other")
    if not_so is None:
        return Inference("yes", "nothing makes the premises true and it false")
    if so is None:
        return Inference("no", "nothing makes the premises true and it too")
    return Inference("unknown", f"true with {_shown(so)}, false with {_shown(not_so)}")


def _shown(world: World) -> str:
    return str(world) or "nothing there"
