"""The information state: one record of the type `State` of the theory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from kille.dialogue.meanings import KINDS, DialogueTypes, packaged_types
from kille.dialogue.reference.perspectives import OPEN
from kille.dialogue.strategies import strategy as default
from ttr import Model, Record, record

NO_LOOK = "look0"
"""The look before the first look, in which nothing is in view."""


def initial(
    signs: Iterable[Record] = (),
    strategy: Record | None = None,
    colours: Iterable[Record] = (),
    taught: Iterable[Record] = (),
    kinds: Iterable[Record] = (),
    criteria: Iterable[Record] = (),
) -> Record:
    """The state in which a dialogue begins: words are known, nothing has been said.

    The strategy is a value of `kille.dialogue.strategies`; `colours` are those of the
    adjectives that answer what colour something is; `taught` says how many lessons
    there were in a word before, as `Taught`, and `kinds` which kinds of things were
    said to be kinds of others, as `Kind`; `criteria` by what things are known.

    >>> from kille.dialogue.meanings import noun, record_type
    >>> s = initial([noun("cup")])
    >>> blank_model().judge(s, record_type("State")).holds
    True
    """
    words = list(signs)
    known = {f"{kind}s": [it for it in words if it.kind == kind] for kind in KINDS}
    return record(
        private=record(
            agenda=[],
            beliefs=[],
            asked=[],
            lessons=[],
            taught=list(taught),
            kinds=list(kinds),
            criteria=list(criteria),
            last=[],
            failed=[],
            colours=list(colours),
            news=[],
            cost=record(turns=0.0, words=0.0, corrections=0.0, questions=0.0),
            strategy=default() if strategy is None else strategy,
            **known,
        ),
        view=record(look=NO_LOOK, things=[], placed=[], focus=[], pointed=[]),
        shared=record(
            latest=record(),
            pending=[],
            commitments=[],
            qud=[],
            salient=[],
            topic=[],
            shown=[],
            frame=OPEN,
            turned=[],
            here=[],
            floor=[],
            cut=[],
            sights=[],
            noticed=[],
            salience=[],
        ),
    )


def words(s: Record) -> Iterator[Record]:
    """All words that are known in a state."""
    for kind in KINDS:
        yield from s.private[f"{kind}s"]


def blank_model(types: DialogueTypes | None = None) -> Model:
    """The model in which a dialogue begins: texts are strings, numbers are floats."""
    types = types or packaged_types()
    return (
        Model(types.theory)
        .witnessed(types["Text"], by=lambda a: isinstance(a, str))
        .witnessed(types["Number"], by=lambda a: isinstance(a, float))
        .given(NO_LOOK, types["Look"])
    )
