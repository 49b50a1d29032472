"""The information state: one record of the type `State` of the theory."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from kille.dialogue.meanings import named, theory, word_of
from ttr import Model, Record, RecordType, record

__all__ = ["STATE", "blank_model", "forms", "initial"]

STATE: RecordType = named("State")
"""The type of every information state."""

NO_LOOK = "look0"
"""The look before the first look, in which nothing is in view."""


def initial(
    nouns: Iterable[Record], relations: Iterable[Record], bands: Mapping[str, float]
) -> Record:
    """The state in which a dialogue begins: words are known, nothing has been said.

    >>> from kille.dialogue.meanings import noun
    >>> bands = {"sure": 0.6, "margin": 0.2, "likely": 0.2, "might": 0.1}
    >>> s = initial([noun("cup")], [], bands)
    >>> blank_model().judge(s, STATE).holds
    True
    """
    return record(
        private=record(
            agenda=[],
            nouns=list(nouns),
            relations=list(relations),
            beliefs=[],
            asked=[],
            **{name: float(band) for name, band in bands.items()},
        ),
        view=record(look=NO_LOOK, things=[], placed=[], focus=[]),
        shared=record(latest=record(), pending=[], commitments=[]),
    )


def blank_model() -> Model:
    """The model in which a dialogue begins: texts are strings, numbers are floats."""
    types = theory()
    return (
        Model(types)
        .witnessed(types["Text"], by=lambda a: isinstance(a, str))
        .witnessed(types["Number"], by=lambda a: isinstance(a, float))
        .given(NO_LOOK, types["Look"])
    )


def forms(*signs: Iterable[Record]) -> dict[str, str]:
    """The form of each word, by the name of its predicate."""
    return {word_of(sign).name: sign.form for some in signs for sign in some}
