"""Does a sentence follow from others? Yes, no, or unknown; never wrongly yes or no.

Properties divide the world into regions, as circles do in a Venn diagram, and sentences
say how many things are in which regions. The hypothesis follows if no numbers make the
premises true and the hypothesis false; it is refuted if none make all of them true. A
property that cannot be analysed, as "wants to sing", is a circle of its own: so nothing
is proved that does not hold, but what depends on its parts stays unknown.
"""

from __future__ import annotations

from collections.abc import Iterable

from ttr.computing.subtyping import Answer
from ttr.errors import UnsupportedError
from ttr.safety.budgets import within_budget
from ttr.semantics.argument_checks import as_tuple
from ttr.semantics.fragment.formulas import Formula, Negated, content_formula
from ttr.semantics.fragment.integer_feasibility import UndecidedError
from ttr.semantics.fragment.lexicon import Lexicon, lexicon_of
from ttr.semantics.fragment.sentences import Sentence, understand
from ttr.semantics.fragment.venn_regions import World, WorldFinder
from ttr.semantics.quantifiers.thresholds import Thresholds, thresholds_of


@within_budget
def follows(
    premises: Iterable[str | Sentence],
    hypothesis: str | Sentence,
    words: Lexicon | None = None,
    thresholds: Thresholds | None = None,
) -> Answer:
    """Does a sentence follow from others, for an agent with these thresholds?

    Where that is unknown, the reason is a world each way. Raises `OutsideFragmentError`
    for a sentence that cannot be read.

    >>> print(follows(["Every dog barks.", "Fido is a dog."], "Fido barks.").verdict)
    yes
    >>> print(follows(["No dog barks."], "Some dog barks.").verdict)
    no
    >>> print(follows(["Some dog barks."], "Every dog barks.").verdict)
    unknown
    """
    premises = as_tuple(premises, "sentences as premises")
    chosen, agent = lexicon_of(words), thresholds_of(thresholds)
    given = [_formula_of(one, chosen, agent) for one in premises]
    wanted = _formula_of(hypothesis, chosen, agent)
    try:
        return _answer(given, wanted, WorldFinder(chosen, agent))
    except (UndecidedError, UnsupportedError) as error:
        return Answer("unknown", str(error) or "it takes too many steps")


def _formula_of(one: str | Sentence, words: Lexicon, thresholds: Thresholds) -> Formula:
    sentence = one if isinstance(one, Sentence) else understand(one, words)
    return content_formula(sentence.content, thresholds)


def _answer(given: list[Formula], wanted: Formula, worlds: WorldFinder) -> Answer:
    so = worlds.find_world([*given, wanted])
    not_so = worlds.find_world([*given, Negated(wanted)])
    if so is None and not_so is None:
        return Answer("unknown", "the premises contradict each other")
    if not_so is None:
        return Answer("yes", "nothing makes the premises true and it false")
    if so is None:
        return Answer("no", "nothing makes the premises true and it too")
    why = f"true with {_in_words(so)}, false with {_in_words(not_so)}"
    return Answer("unknown", why)


def _in_words(world: World) -> str:
    return str(world) or "nothing there"
