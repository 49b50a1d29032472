"""Laws of inference: no model makes the premises true and a proved answer wrong."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Ind, Model
from ttr.semantics.fragment import english, follows, understand
from ttr.semantics.quantifiers import UndefinedError

DETERMINERS = (
    *("every", "some", "no", "not every", "most", "many", "few", "several", "the"),
    *("both", "neither", "at least two", "at most one", "exactly one", "more than one"),
)
NOUNS = ("dog", "puppy", "boy")
NAMES = ("Fido", "Kim")
DOING = (
    *("barks", "is brown", "does not bark", "hugs Kim", "hugs a boy", "hugs no dog"),
    *("hugs every dog", "hugs most boys", "hugs a boy that Kim hugs"),
)
WITH = ("", " that barks", " that is not brown", " that hugs a boy", " that Kim hugs")

subjects = st.one_of(
    st.sampled_from(NAMES),
    st.builds(
        "{} {}{}".format,
        st.sampled_from(DETERMINERS),
        st.sampled_from(NOUNS),
        st.sampled_from(WITH),
    ),
)
predications = st.builds(
    "{} {}".format, subjects, st.sampled_from((*DOING, "is a dog", "is Fido"))
)
denials = st.builds("it is not the case that {}".format, predications)
sentences = st.one_of(predications, predications, denials)

WORDS = english()
UNARY = [
    WORDS.meaning(*it)
    for it in (
        *(("NOUN", noun) for noun in NOUNS),
        ("ADJ", "brown"),
        ("IV", "bark"),
    )
]
HUG = WORDS.meaning("TV", "hug")
THINGS = ("fido", "kim", "other", "more")


@st.composite
def models(draw):
    """Models of two to four things, who are what they are, and hug whom they hug."""
    things = THINGS[: draw(st.integers(2, 4))]
    M = Model(WORDS.theory)
    for name in things:
        M = M.given(name, Ind)
    for pred, name in product(UNARY, things):
        if draw(st.booleans()):
            M = M.given(f"{pred.name}_{name}", pred(name))
    for x, y in product(things, repeat=2):
        if draw(st.integers(0, 2)) == 0:
            M = M.given(f"hug_{x}_{y}", HUG(x, y))
    return M


def true_in(M, sentence):
    """Whether a sentence is true; None where it is neither true nor false."""
    try:
        return sentence.judge(M).p.lo == 1
    except UndefinedError:
        return None


def facts(M, texts):
    """Of each sentence, it or its denial, whichever is true in the model."""
    for text in texts:
        true = true_in(M, understand(text))
        if true is not None:
            yield text if true else f"it is not the case that {text}"


@pytest.mark.slow
@given(models(), st.lists(sentences, min_size=1, max_size=3), sentences)
def test_what_is_proved_is_so_in_every_model(M, texts, hypothesis):
    verdict = follows(list(facts(M, texts)), hypothesis).verdict
    true = true_in(M, understand(hypothesis))
    # A share of nothing is neither true nor false in a model.
    assert verdict != "yes" or true is not False
    assert verdict != "no" or true is not True


@given(sentences)
def test_a_sentence_follows_from_itself(text):
    assert follows([text], text).verdict in ("yes", "unknown")


@pytest.mark.slow
@given(sentences)
def test_a_sentence_and_its_denial_refute_each_other(text):
    denial = f"it is not the case that {text}"
    assert follows([text], denial).verdict in ("no", "unknown")
    assert follows([denial], text).verdict in ("no", "unknown")
