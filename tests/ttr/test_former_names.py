"""Names of `ttr.semantics` until the last release: they still work, and warn."""

from __future__ import annotations

from importlib import import_module

import pytest

FORMER = {
    "fragment.picked_up": "pronoun_antecedents",
    "gameboards.kos.said": "utterance",
    "perceptual.detected": "detections",
    "perceptual.individuated": "individuate",
    "questions.resolving": "find_answer",
    "string_prediction.begun": "start_course",
    "topoi.combined": "combine_topoi",
    "topoi.expected": "expectation",
}


@pytest.mark.parametrize("former", FORMER)
def test_a_former_name_works_and_warns(former: str) -> None:
    path, _, name = former.rpartition(".")
    module = import_module(f"ttr.semantics.{path}")
    with pytest.warns(DeprecationWarning, match=f"{name} is now .*{FORMER[former]}$"):
        found = getattr(module, name)
    assert found is getattr(module, FORMER[former])


def test_what_was_never_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'gibberish'"):
        _ = import_module("ttr.semantics.topoi").gibberish
