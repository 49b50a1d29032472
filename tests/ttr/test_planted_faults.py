"""Faults that other engines load without a word, planted in files and in Python.

Each is found before anything runs. The files are those of `tests/theories/planted`.
"""

import re
from pathlib import Path

import pytest

from ttr import Basic, ListOf, Model, Theory, TTRError, record, rectype, replace
from ttr.cli.main import main
from ttr.updates import by_class, first, nbest, repeat, rule
from ttr.updates.checks import faults

PLANTED = Path(__file__).resolve().parent.parent / "theories" / "planted"

# --- in files ------------------------------------------------------------------------

IN_FILES = {
    "misspelt_attribute": (
        "fault: the rule keep writes shared.lsat, but shared has no lsat",
        "10:46",
        "lsat",
    ),
    "too_probable": (
        "error: a probability is a number in [0, 1] or an interval of two, lower "
        "first, but found (0.9, 1.8)",
        "10:34",
        "[0.9, 1.8]",
    ),
    "after_an_unconditional_case": (
        "fault: the rule confirm can never fire: the rule ask comes first, and "
        "applies wherever confirm would",
        "11:6",
        "confirm",
    ),
    "subsumed_case": (
        "fault: the rule confirm can never fire: the rule ask comes first, and "
        "applies wherever confirm would",
        "11:6",
        "confirm",
    ),
    "misspelt_condition": (
        "fault: the rule ask asks for pahse, but a state has no pahse",
        "10:15",
        "pahse",
    ),
    "unbound_slot": ("error: nothing is called Y here", "10:53", "Y"),
    "misspelt_keyword": (
        "error: expected :=, of or where, found whree",
        "10:32",
        "whree",
    ),
    "trigger_that_nobody_sets": (
        "fault: the rule book can never fire: it waits until phase is confirming, "
        "which neither the start nor any rule before it brings about",
        "11:16",
        "phase",
    ),
    "value_of_another_type": (
        "fault: the rule keep sets shared.last to banana, which is no City",
        "10:46",
        "last",
    ),
    "two_that_disagree": (
        "fault: the rules ask and confirm in the class integrate may both apply, but "
        "set phase to asking and to confirming",
        "11:52",
        "phase",
    ),
    "rule_that_triggers_itself": (
        "fault: repeat(grow) need not end: grow leaves its own condition as it is",
        "10:6",
        "grow",
    ),
}
"""The first line of the report, and which word of which place is underlined."""


def test_all_the_planted_files_are_tried() -> None:
    assert {file.stem for file in PLANTED.glob("*.ttr")} == set(IN_FILES)


@pytest.mark.parametrize("name", sorted(IN_FILES))
def test_planted_in_a_file(name, monkeypatch, capsys) -> None:
    first_line, place, word = IN_FILES[name]
    monkeypatch.chdir(PLANTED)
    assert main(["check", f"{name}.ttr"]) == 1
    out, err = capsys.readouterr()
    report = (out + err).splitlines()
    assert report[0] == first_line
    assert report[1].endswith(f"┌─ {name}.ttr:{place}")
    assert underlined(report[2:4]) == word


def underlined(lines):
    """What the carets in the second line stand under."""
    carets = re.search(r"\^+", lines[1])
    return lines[0][carets.start() : carets.end()]


# --- in Python -----------------------------------------------------------------------

CITIES = Theory.parse("""
    basic City, Phase, Number
    object bergen, oslo : City
    object greeting, asking, confirming : Phase
""")
City, Phase, Number = CITIES.City, CITIES.Phase, CITIES.Number
Tell = rectype(city=City)
Board = rectype(phase=Phase, n=Number, shared=rectype(cities=ListOf(City), last=City))
Greeting, Asking = rectype(phase=Phase @ "greeting"), rectype(phase=Phase @ "asking")
START = record(phase="greeting", n=0, shared=record(cities=[], last="oslo"))
M = Model(CITIES).witnessed(Number, by=lambda n: isinstance(n, int))


@rule(when=Board, on=Tell)
def misspelt_attribute(s, e):
    return replace(s, {"shared.lsat": e.city})


@rule(when=Board, on=Tell)
def misspelt_reading(s, e):
    return replace(s, {"shared.last": s.shared.ciites[0]})


@rule(when=Board, on=Tell)
def misspelt_event(s, e):
    return replace(s, {"shared.last": e.ctiy})


@rule(when=Board, on=Tell)
def ask(s, e):
    return replace(s, phase="asking")


@rule(when=Greeting, on=Tell)
def confirm(s, e):
    return replace(s, phase="confirming")


@rule(when=Greeting, on=Tell)
def ask_first(s, e):
    return replace(s, phase="asking")


@rule(when=rectype(phase=Phase @ "greeting", shared=rectype(cities=ListOf(City) @ ())))
def ask_last(s):
    return replace(s, phase="confirming")


@rule(when=Greeting)
def ask_at_once(s):
    return replace(s, phase="asking")


@rule(when=rectype(pahse=Phase), on=Tell)
def misspelt_condition(s, e):
    return replace(s, phase="asking")


@rule(when=Board, on=Tell)
def unbound_slot(s, e):
    return replace(s, {"shared.last": wanted})  # noqa: F821


@rule(when=rectype(phase=Phase @ "confirming"), on=Tell)
def book(s, e):
    return replace(s, {"shared.last": e.city})


@rule(when=Board)
def value_of_another_type(s):
    return replace(s, n="banana")


@rule(when=Board, on=Tell, kind="integrate")
def asking(s, e):
    return replace(s, phase="asking")


@rule(when=Board, on=Tell, kind="integrate")
def confirming(s, e):
    return replace(s, phase="confirming")


@rule(when=Board)
def grow(s):
    return replace(s, n=s.n + 1)


IN_PYTHON = {
    "misspelt attribute": (
        misspelt_attribute,
        "the rule misspelt_attribute replaces s.shared.lsat, but s.shared has no lsat",
        '"shared.lsat"',
    ),
    "misspelt reading": (
        misspelt_reading,
        "the rule misspelt_reading reads s.shared.ciites, but s.shared has no ciites",
        "ciites",
    ),
    "misspelt label of an event": (
        misspelt_event,
        "the rule misspelt_event reads e.ctiy, but e has no ctiy",
        "ctiy",
    ),
    "after an unconditional case": (
        first(ask, confirm),
        "the rule confirm can never fire: the rule ask comes first, and applies "
        "wherever confirm would",
        "confirm",
    ),
    "subsumed case": (
        first(ask_at_once, ask_last),
        "the rule ask_last can never fire: the rule ask_at_once comes first, and "
        "applies wherever ask_last would",
        "ask_last",
    ),
    "misspelt condition": (
        misspelt_condition,
        "the rule misspelt_condition asks for pahse, but a state has no pahse",
        "pahse",
    ),
    "unbound slot": (
        unbound_slot,
        "the rule unbound_slot uses wanted, which nothing binds",
        "wanted",
    ),
    "trigger that nobody sets": (
        first(ask_first, book),
        "the rule book can never fire: it waits until phase is confirming, which "
        "neither the start nor any rule before it brings about",
        "phase",
    ),
    "value of another type": (
        value_of_another_type,
        "the rule value_of_another_type sets n to banana, which is no Number",
        "n",
    ),
    "two that disagree": (
        by_class(asking, confirming, order=["integrate"]),
        "the rules asking and confirming in the class integrate may both apply, but "
        "set phase to asking and to confirming",
        "phase",
    ),
    "rule that triggers itself": (
        repeat(grow),
        "repeat(grow) need not end: grow leaves its own condition as it is",
        "grow",
    ),
}
"""What is played, the first line of the fault, and which word is underlined."""


@pytest.mark.parametrize("name", IN_PYTHON)
def test_planted_in_python(name) -> None:
    algorithm, message, word = IN_PYTHON[name]
    (fault,) = faults(algorithm, Board, start=START, model=M)
    lines = str(fault).splitlines()
    assert lines[0] == message
    assert f"{Path(__file__).name}:{fault.span.line}:{fault.span.column}" in lines[1]
    assert underlined(lines[2:4]) == word
    assert fault.severity == "error"


def test_the_same_rules_without_the_faults() -> None:
    played = first(ask_first, ask)
    assert faults(played, Board, start=START, model=M) == ()


def test_probabilities_beyond_one() -> None:
    with pytest.raises(TTRError, match=r"come to at most 1, found 1\.8"):
        nbest(("bergen", 0.9), ("oslo", 0.9))
    with pytest.raises(TTRError, match=r"found 1\.8"):
        rule(when=Board, on=Basic("Tell"), p=1.8)


def test_misspelt_keyword() -> None:
    with pytest.raises(TypeError, match="whne"):
        rule(whne=Board)
