"""Misspelt names: the one that was meant is offered, and nothing that was not."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr.errors import suggestion
from ttr.misspellings import nearest_names
from ttr.semantics.fragment import english

FORMS = sorted({part for form in english().forms for part in form.split()})
LONG = [form for form in FORMS if len(form) > 3]

OTHER_WORDS = """
    somebody nobody everybody anything outside inside perhaps because before during
    between under above against without within although however therefore table kitchen
    window garden river mountain forest street school church hospital university
    language grammar sentence mother father sister brother uncle daughter husband child
    children baby friend neighbour enemy king queen prince water bread butter cheese
    coffee sugar salt meat rice soup orange banana lemon potato run walk jump fly think
    believe remember forget listen touch taste yellow green blue purple tall short heavy
    light quick clever stupid angry sad yesterday tomorrow today tonight morning evening
    night week month year century music theatre cinema museum airport train bicycle
    engine computer telephone elephant lion tiger wolf rabbit mouse snake spider whale
    shark pigeon eagle always often seldom never sometimes usually xylophone zebra
    philosophy mathematics chemistry physics biology
"""


@pytest.mark.parametrize("word", OTHER_WORDS.split())
def test_a_word_that_is_no_misspelling_is_offered_no_other(word):
    assert word in FORMS or nearest_names(word, FORMS) == []


@st.composite
def slips(draw):
    """A form of the lexicon, and the same with one slip after its first letter."""
    form = draw(st.sampled_from(LONG))
    at = draw(st.integers(1, len(form) - 1))
    letter = draw(st.sampled_from("abcdefghijklmnopqrstuvwxyz"))
    wrong = draw(
        st.sampled_from(
            [
                form[:at] + form[at + 1 :],
                form[:at] + letter + form[at:],
                form[:at] + letter + form[at + 1 :],
                form[: at - 1] + form[at] + form[at - 1] + form[at + 1 :],
            ]
        )
    )
    return form, wrong


@given(slips())
def test_one_slip_is_mended(pair):
    form, wrong = pair
    assert form in nearest_names(wrong, FORMS, most=len(FORMS))


@pytest.mark.parametrize(
    ("name", "known", "meant"),
    [
        ("hgu", ["hug", "dog"], ["hug"]),
        ("DOG", ["cat", "dog"], ["dog"]),
        ("dgo", ["Dog", "dog"], ["dog", "Dog"]),
        ("Stat", ["Start", "State"], ["State", "Start"]),
        ("admit", ["admit_name", "agree"], ["admit_name"]),
        ("kichten", ["kitchen"], []),
        ("kichtens", ["kitchens"], ["kitchens"]),
        ("w2", ["w1"], []),
        ("cap", ["cup", "cat"], ["cup"]),
        ("cat", ["car", "bat"], []),
        ("outside", ["house"], []),
        ("", ["a", "b"], []),
        ("x" * 5000, ["x" * 5001], []),
    ],
)
def test_what_is_near(name, known, meant):
    assert nearest_names(name, known, most=3) == meant


def test_a_hint_has_the_nearest_name_alone():
    assert suggestion("pupy", FORMS) == "did you mean puppy?"
    assert suggestion("Somebody", FORMS) == ""
