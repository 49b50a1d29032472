"""The types of the dialogue, read from `grammars/tutor.ttr`, and the meanings of words.

A word is a sign: a form, and a meaning that is the type `Noun` or `Relation` of the
theory with the word's own predicate in place of the one that stands for it there.
"""

from __future__ import annotations

import re
import unicodedata
from functools import cache
from importlib.resources import files

from ttr import (
    Meet,
    Pred,
    PType,
    Record,
    RecordType,
    Singleton,
    Theory,
    TypeNode,
    meet,
    merge,
    record,
    rectype,
)
from ttr.syntax import Object

__all__ = [
    "named",
    "noun",
    "predicate_at",
    "predicate_name",
    "relation",
    "set_to",
    "spoken",
    "theory",
    "value_at",
    "word_of",
]


@cache
def theory() -> Theory:
    """The theory of the dialogue, from the packaged `tutor.ttr`."""
    source = files("kille.grammars").joinpath("tutor.ttr")
    return Theory.parse(source.read_text(encoding="utf-8"), "tutor.ttr")


def named(name: str) -> RecordType:
    """The record type that the theory gives this name.

    >>> print(named("Naming"))
    [look : Look, x : Ind]
    """
    found = theory()[name]
    if not isinstance(found, RecordType):
        raise TypeError(f"{name} of tutor.ttr should be a record type, but is {found}")
    return found


@cache
def spoken(speaking: str, move: str) -> RecordType:
    """The type of a move of the theory, as something that is heard or said.

    >>> greeted = spoken("Heard", "Greet")
    >>> greeted <= named("Heard"), greeted <= named("Greet")
    (True, True)
    """
    both = merge(named(speaking), named(move))
    if not isinstance(both, RecordType):
        raise TypeError(f"{speaking} and {move} of tutor.ttr do not go together")
    return both


def set_to(T: RecordType, **fields: TypeNode) -> RecordType:
    """The record type with some of its fields, or new ones, as they are here.

    >>> from ttr import Ind
    >>> print(set_to(rectype(x=Ind), x=Ind @ "o1"))
    [x = o1 : Ind]
    """
    return rectype({**dict(T.fields), **fields})


def predicate_name(form: str) -> str:
    """What the predicate of a word is called: its form as one identifier.

    >>> predicate_name("Can of Paint"), predicate_name("shoe-box"), predicate_name("3D")
    ('can_of_paint', 'shoe_box', 'n3d')
    """
    plain = unicodedata.normalize("NFKC", form.lower())
    name = re.sub(r"\W+", "_", plain).strip("_")
    name = "".join(c if f"n{c}".isidentifier() else f"u{ord(c):x}" for c in name)
    return name if name.isidentifier() else f"n{name}"


def noun(form: str) -> Record:
    """The sign of a noun.

    >>> print(noun("teddy bear"))  # doctest: +NORMALIZE_WHITESPACE
    {form = "teddy bear",
     meaning = [look : Look, x : Ind, c : teddy_bear(x, look)]}
    """
    return _sign(form, "Noun", "noun")


def relation(form: str) -> Record:
    """The sign of a relation, such as "to the left of"."""
    return _sign(form, "Relation", "relation")


def _sign(form: str, template: str, stands_for: str) -> Record:
    pattern = theory()[stands_for]
    own = Pred(predicate_name(form), *pattern.arities)
    return record(form=form.lower(), meaning=_with(named(template), pattern, own))


def _with(T: TypeNode, pattern: Pred, own: Pred) -> TypeNode:
    """The type with one predicate in place of another."""
    match T:
        case PType(pred, args) if pred is pattern:
            return own(*args)
        case RecordType(fields):
            return rectype({k: _with(field, pattern, own) for k, field in fields})
        case Meet(parts):
            return meet(*(_with(part, pattern, own) for part in parts))
        case Singleton(base, value):
            return Singleton(_with(base, pattern, own), value)
    return T


def word_of(sign: Record) -> Pred:
    """The predicate that is a sign's own: the one field of its meaning with a ptype."""
    for _, field in sign.meaning.fields:
        if isinstance(field, PType):
            return field.pred
    raise TypeError(f"the meaning of {sign.form!r} has no predicate of its own")


def value_at(T: RecordType, label: str) -> Object:
    """What a manifest field is set to.

    >>> from ttr import Ind
    >>> value_at(rectype(x=Ind @ "o1"), "x")
    'o1'
    """
    field = T[label]
    if isinstance(field, Singleton):
        return field.value
    raise TypeError(f"the field {label} of {T} is not set to anything")


def predicate_at(T: RecordType, label: str) -> Pred:
    """The predicate of the ptype that a field has."""
    field = T[label]
    if isinstance(field, PType):
        return field.pred
    raise TypeError(f"the field {label} of {T} is no ptype")
