"""Theories shown: by what they differ, in the notation of the literature.

What is the same for all theories of a study is there as well, under the same names and
in the same order, so that they can be set side by side.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from kille.dialogue.meanings import KINDS, DialogueTypes
from kille.dialogue.strategies import strategy
from kille.lab.study import PERSON, Theory
from kille.lab.theories.games import strategy_of
from kille.lab.theories.meanings import meanings_of
from kille.lab.theories.rules import algorithm_of, describe_rule, packaged_rules
from kille.lab.worlds.vocabulary import vocabulary
from ttr import Record, record
from ttr.types import TypeNode
from ttr.updates import rules_of

Part = TypeNode | Record | str | Mapping[str, str] | Mapping[str, TypeNode]

_EXAMPLES = {"noun": ("nouns", "cup"), "adjective": ("adjectives", "red")}
_PLACE = ("relations", "left")


def describe(theory: Theory) -> Mapping[str, Part]:
    """A theory by its parts: its strategy, its learners, the meaning of a word of each
    kind, what its types are called, its information states, its rules, its language.

    `TheoryError` where it cannot be used.

    >>> print(describe(Theory("proto", learners={"noun": "prototype"}))["learners"])
    {adjective = default, noun = prototype, relation = default}
    >>> print(describe(Theory("proto"))["noun"])
    [look : Look, x : Ind, c : cup(x, look)]
    """
    types = meanings_of(theory)
    learners = {
        kind: _short_name(theory.learners.get(kind, "default")) for kind in KINDS
    }
    by_person = theory.mode == PERSON
    return {
        "about": theory.about,
        "language": _language(theory),
        "strategy": strategy() if by_person else strategy_of(theory),
        "learners": record(learners),
        **{kind: _example_meaning(theory.language, kind, types) for kind in KINDS},
        "meanings": _meanings(types),
        "state": types.record_type("State"),
        "rules": {} if by_person else _rules(theory),
    }


def rules_apart(one: Theory, other: Theory) -> Mapping[str, tuple[str, str]]:
    """The rules in which two theories differ, as each has them; one may lack it.

    >>> [(name, texts[1]) for name, texts in rules_apart(
    ...     Theory("all"), Theory("bold", without=("hedge_name",))).items()]
    [('hedge_name', '')]
    """
    ours, theirs = _rules(one), _rules(other)
    names = dict.fromkeys([*ours, *theirs])
    both = {name: (ours.get(name, ""), theirs.get(name, "")) for name in names}
    return {name: it for name, it in both.items() if it[0] != it[1]}


def _rules(theory: Theory) -> Mapping[str, str]:
    packaged = packaged_rules(meanings_of(theory))
    return {
        rule.name: describe_rule(rule, packaged)
        for rule in rules_of(algorithm_of(theory))
    }


def _example_meaning(language: str, kind: str, types: DialogueTypes) -> TypeNode:
    words, name = _EXAMPLES.get(kind, _PLACE)
    meaning = getattr(vocabulary(language, types), words)[name].meaning
    assert isinstance(meaning, TypeNode)
    return meaning


def _meanings(types: DialogueTypes) -> Mapping[str, TypeNode]:
    """All types by which words, phrases and moves have their meanings."""
    state, named = types["State"], types.theory.definitions
    return {name: T for name, T in named.items() if T is not state}


def _language(theory: Theory) -> str:
    own = "" if theory.grammar is None else f" with {theory.grammar.name}"
    return f"{theory.language}{own}"


def _short_name(name: str) -> str:
    """What a learner is called, without where its file is."""
    path, colon, thing = name.rpartition(":")
    return f"{Path(path).name}{colon}{thing}"
