"""Judgements are what was recorded: degrees and derivations, and what is certain.

Each file is a theory and then blocks, `object :: type` with the derivation below. They
were drawn at random, of every kind of type.
"""

import re
from pathlib import Path

import pytest

from ttr import ListOf, Model, RecordType, Theory
from ttr.judging.certainty import is_certain, is_certain_given
from ttr.probability import CERTAIN
from ttr.types import NonEmpty, Singleton

FOLDER = Path(__file__).parent / "recorded_judgements"


def recorded_judgements():
    """The model, object, type and derivation of each block."""
    for file in sorted(FOLDER.glob("*.txt")):
        text, *blocks = file.read_text(encoding="utf-8").rstrip("\n").split("\n\n")
        theory = Theory.parse(text)
        M = Model(theory)
        for block in blocks:
            claim, _, derivation = block.partition("\n")
            sit, _, T = claim.partition(" :: ")
            value = (M, theory.parse(sit), theory.parse(T), derivation)
            yield pytest.param(*value, id=f"{file.stem}: {claim}")


RECORDED = list(recorded_judgements())

KNOWN = [
    one.values[2]
    for one in RECORDED[::2]
    if isinstance(one.values[2], RecordType | ListOf | NonEmpty | Singleton)
]
"""Types of which something may be known already."""


def test_many_are_recorded_of_every_kind():
    assert len(RECORDED) == 401
    assert len({type(one.values[2]) for one in RECORDED}) == 15


@pytest.mark.parametrize(("M", "sit", "T", "derivation"), RECORDED)
def test_derivations_are_as_recorded(M, sit, T, derivation):
    found = str(M.judge(sit, T).why)
    if "\\" in derivation or "->" in derivation:
        found, derivation = outline(found), outline(derivation)
    assert found == derivation


def outline(derivation):
    """Its degrees, step by step: how a bound variable is called is no matter."""
    return re.findall(r"^ *(?:✓|✗|p = (?:\[.*?\]|\S*))", derivation, re.MULTILINE)


@pytest.mark.parametrize(("M", "sit", "T", "derivation"), RECORDED)
def test_what_is_certain_is_as_recorded(M, sit, T, derivation):
    found = derivation.startswith("✓")
    assert is_certain(M.facts, sit, T) is found
    assert (M.judge(sit, T).p == CERTAIN) is found


@pytest.mark.parametrize(("M", "sit", "T", "derivation"), RECORDED)
def test_what_is_certain_given_what_is_known_is_as_recorded(M, sit, T, derivation):
    found = derivation.startswith("✓")
    for known in KNOWN:
        if is_certain(M.facts, sit, known):
            assert is_certain_given(M.facts, sit, T, known) is found
