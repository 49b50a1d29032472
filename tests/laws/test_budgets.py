"""Laws of budgets: the end of one never becomes a yes, a no or another type."""

from __future__ import annotations

from generators import types
from hypothesis import given
from hypothesis import strategies as st

import ttr
from ttr import Theory, merge, subtype
from ttr.computing import normal_form
from ttr.errors import TooLargeError
from ttr.safety.budgets import open_purse, within_budget

WORDS = ["Red", "Big", "Twice"]
LEXICON = r"""
basic Ind
pred dog(Ind), red(Ind), big(Ind)
Dog   := \v:Ind. [e : dog(v)]
Red   := \P:(Ind -> RecType). \v:Ind. merge(P(v), [r : red(v)])
Big   := \P:(Ind -> RecType). \v:Ind. merge(P(v), [b : big(v)])
Twice := \P:(Ind -> RecType). \v:Ind. [l : P(v), r : P(v)]
Every := \P:(Ind -> RecType). \Q:(Ind -> RecType). [f : ((x : Ind) -> (P(x) -> Q(x)))]
"""


@given(types(), types(), st.integers(1, 400))
def test_a_budget_only_ever_turns_an_answer_into_unknown(S, T, steps):
    whole = subtype(S, T)
    with ttr.budget(steps=steps):
        short = subtype(S, T)
    assert short.verdict in (whole.verdict, "unknown")
    assert subtype(S, T).verdict == whole.verdict  # nothing half done was kept


@given(types(), types(), st.integers(1, 400))
def test_a_merge_is_the_whole_one_or_none(S, T, steps):
    whole = merge(S, T)
    try:
        with ttr.budget(steps=steps):
            assert merge(S, T) is whole
    except TooLargeError:
        assert merge(S, T) is whole


@given(st.lists(st.sampled_from(WORDS), min_size=1, max_size=5))
def test_a_normal_form_costs_the_same_whatever_was_asked_before(words):
    """Also where others were computed on the way, or parts of it by themselves."""

    def steps(theory: Theory, T: str) -> int:
        parsed = theory.parse(T)

        @within_budget
        def ask() -> int:
            before = open_purse().left  # type: ignore[union-attr]
            normal_form(parsed, theory)
            return before - open_purse().left  # type: ignore[union-attr]

        return ask()

    phrase = "Dog"
    parts = [phrase := f"{word}({phrase})" for word in words]
    whole = f"Every({phrase})(Dog)"
    fresh = steps(Theory.parse(LEXICON), whole)
    theory = Theory.parse(LEXICON)
    for part in parts:
        steps(theory, part)
    # Which paths lead out of a type is kept with it.
    assert fresh * 0.9 <= steps(theory, whole) <= fresh * 1.1
    again = steps(theory, whole)
    assert again == steps(theory, whole) >= fresh * 0.9


@given(st.lists(st.sampled_from(WORDS), max_size=3), st.integers(1, 900))
def test_a_normal_form_is_the_whole_one_or_none(words, steps):
    """A budget that ends in a presupposition leaves no application that is kept."""
    phrase = "Dog"
    for word in words:
        phrase = f"{word}({phrase})"
    theory = Theory.parse(LEXICON)
    sentence = theory.parse(f"Every({phrase})(Dog)")
    try:
        with ttr.budget(steps=steps):
            short = normal_form(sentence, theory)
    except TooLargeError:
        short = None
    whole = normal_form(sentence, theory)  # nothing half done was kept
    other = Theory.parse(LEXICON)
    assert whole is normal_form(other.parse(f"Every({phrase})(Dog)"), other)
    assert short is None or short is whole
