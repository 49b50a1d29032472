"""What follows from what: pairs with the right answer each."""

from __future__ import annotations

import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

from ttr.semantics.fragment import follows, understand
from ttr.semantics.quantifiers import Thresholds, number, share

PAIRS = tomllib.loads((Path(__file__).parent / "pairs.toml").read_text("utf-8"))["pair"]
REACHED = [pair for pair in PAIRS if not pair.get("beyond")]
BEYOND = [pair for pair in PAIRS if pair.get("beyond")]


def named(pair):
    return f"{' '.join(pair['premises'])} {pair['hypothesis']}"


@pytest.mark.parametrize("pair", REACHED, ids=named)
def test_a_pair_is_answered(pair):
    assert follows(pair["premises"], pair["hypothesis"]).verdict == pair["answer"]


@pytest.mark.parametrize("pair", BEYOND, ids=named)
def test_what_is_beyond_the_procedure_is_unknown_and_never_wrong(pair):
    assert pair["answer"] != "unknown"
    assert follows(pair["premises"], pair["hypothesis"]).verdict == "unknown"


def test_there_are_about_forty_pairs_of_every_kind():
    assert len(REACHED) >= 40
    assert {pair["answer"] for pair in REACHED} == {"yes", "no", "unknown"}


def test_an_agent_goes_by_its_own_thresholds():
    nearly_all = Thresholds(many=share("at least", 0.9))
    premises = ["Many dogs bark.", "Many dogs are brown."]
    hypothesis = "Some brown dog barks."
    assert follows(premises, hypothesis, None, nearly_all).verdict == "yes"
    two = Thresholds(few=number("at most", 2))
    assert follows(["Few dogs bark."], "Few brown dogs bark.", None, two).verdict == (
        "yes"
    )


def test_unknown_comes_with_a_world_each_way():
    found = follows(["Some dog barks."], "Every dog barks.")
    assert found.verdict == "unknown"
    assert found.why.startswith("true with 1 of")
    assert "false with" in found.why


def test_premises_that_contradict_each_other_say_nothing():
    found = follows(["Kim swims.", "Kim does not swim."], "Fido barks.")
    assert str(found) == "unknown: the premises contradict each other"


def test_too_much_to_look_at_is_unknown():
    nouns = ["dog", "cat", "horse", "bird", "boy", "girl", "farmer", "vet", "sailor"]
    nouns += ["baker", "tenor", "boat", "gun", "ball", "book", "letter", "song"]
    premises = [f"Every {a} is a {b}." for a, b in pairwise(nouns)]
    found = follows(premises, "Every dog is a song.")
    assert found.verdict == "unknown"


def test_sentences_may_be_read_before():
    known = understand("Every dog barks.")
    assert follows([known, "Fido is a dog."], "Fido barks.").verdict == "yes"


def test_relations_that_divide_the_world_too_finely_are_left():
    premises = [
        "Fido hugs Kim loudly.",
        "Fido sleeps near Kim.",
        "Kim hugs Fido loudly.",
    ]
    assert follows(premises, "Fewer than two big animals bark.").verdict == "unknown"
