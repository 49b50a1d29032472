"""Whatever is said is answered, and nothing is learned that the tutor did not say.

`benchmarks/sentences.py` plays hundreds of thousands of such sentences.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.language import LANGUAGES
from kille.dialogue.robust_reading.clause_words import words_of
from kille.dialogue.word_lists import word_lists

SCRIPT = Path(__file__).parents[3] / "benchmarks" / "sentences.py"


def load_script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("sentences", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


SENTENCES = load_script()


@given(st.integers(0, 10**9), st.sampled_from(LANGUAGES))
def test_odd_sentences_teach_nothing_that_was_not_said(
    seed: int, language: str
) -> None:
    assert list(SENTENCES.dialogue(f"law {seed}", language, 8)) == []


@pytest.mark.parametrize(
    ("text", "form", "denied"),
    [
        ("this is not a cup", "cup", True),
        ("not a vase but a bottle", "bottle", False),
        ("that's not an apple, that's a ball", "ball", False),
        ("no no it's a pear", "pear", False),
        ("it is red and not blue", "red", False),
    ],
)
def test_what_is_denied_is_seen(text: str, form: str, denied: bool) -> None:
    english = word_lists("en")
    found = SENTENCES._is_denied(form, words_of(text, english), english)
    assert found is denied
