"""The types of the dialogue, read from `grammars/tutor.ttr`, and the meanings of words.

A word is a sign: a form, and a meaning that is the type `Noun`, `Adjective` or
`Relation` of the theory with the word's own predicate in place of the one that stands
for it there. In other places the word means other types, made in the same way.

`DialogueTypes` has the types of a theory; whoever needs a type is given this value. The
functions `theory`, `record_type`, `move_type`, `sign`, `noun`, `adjective`,
`relation`, `kind_in`, `meaning_in` and `meaning_at` are about the packaged theory.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache, lru_cache
from typing import Any, Concatenate, ParamSpec, TypeVar

from kille.dialogue.theory_files import packaged_theory
from ttr import (
    Model,
    Pred,
    Record,
    RecordType,
    Theory,
    join,
    meet,
    merge,
    record,
    rectype,
)
from ttr.aliases import former_names
from ttr.judging.certainty import is_certain
from ttr.types import Meet, Negation, PType, Singleton, TypeNode
from ttr.types.derived_types import order_fields
from ttr.types.objects import Object
from ttr.types.paths import free_paths

__getattr__ = former_names(
    __name__,
    {
        "denied": "denial",
        "named": "record_type",
        "placed": "meaning_at",
        "reworded": "replace_word",
        "spoken": "move_type",
    },
)

__all__ = [
    "CLAIMS",
    "KINDS",
    "DialogueTypes",
    "adjective",
    "claims",
    "denial",
    "is_denial",
    "kind_in",
    "meaning_in",
    "mentions",
    "merge_of",
    "record_type",
    "noun",
    "packaged_types",
    "meaning_at",
    "predicate_at",
    "predicate_name",
    "relation",
    "replace_word",
    "set_at",
    "set_to",
    "sign",
    "move_type",
    "theory",
    "value_at",
    "word_of",
]


KINDS = ("noun", "adjective", "relation")
"""The kinds of words, by the names of the predicates that stand for them.

>>> from kille.dialogue.meanings import KINDS
>>> KINDS
('noun', 'adjective', 'relation')
"""


_P = ParamSpec("_P")
_R = TypeVar("_R")


@dataclass(frozen=True, eq=False)
class DialogueTypes:
    """The types of a dialogue, by the names that a theory gives them.

    Languages, rules and games are derived from it, and it keeps what was derived. Its
    items are whatever has a name in the theory.

    >>> types = packaged_types()
    >>> print(types["Phrase"])
    [look : Look, x : Ind]
    """

    theory: Theory
    _derived: dict[object, Any] = field(default_factory=dict, init=False, repr=False)

    def __getitem__(self, name: str) -> Any:
        return self.theory[name]

    def __contains__(self, name: str) -> bool:
        return name in self.theory

    def derive(
        self,
        make: Callable[Concatenate[DialogueTypes, _P], _R],
        *given: _P.args,
        **named: _P.kwargs,
    ) -> _R:
        """The value of a pure function of these types, computed once and kept.

        >>> types = packaged_types()
        >>> make = lambda types, name: [types[name]]
        >>> types.derive(make, "Phrase") is types.derive(make, "Phrase")
        True
        """
        key = (make, given, tuple(named.items()))
        if key not in self._derived:
            self._derived.setdefault(key, make(self, *given, **named))
        derived: _R = self._derived[key]
        return derived

    def record_type(self, name: str) -> RecordType:
        """The record type that the theory gives this name; `TypeError` for another."""
        found = self.theory[name]
        if not isinstance(found, RecordType):
            raise TypeError(
                f"{name} of {self.theory.source} should be a record type, but is "
                f"{found}"
            )
        return found

    def has(self, sit: Object, name: str, model: Model) -> bool:
        """Whether an object certainly is of the type of this name: a move, for example.

        >>> from kille.dialogue.state import blank_model, initial
        >>> packaged_types().has(initial(), "State", blank_model())
        True
        """
        return is_certain(model.facts, sit, self.theory[name])

    def move_type(self, speaking: str, move: str) -> RecordType:
        """The type of a move of the theory, as something that is `Heard` or `Said`."""
        return self.derive(_move_type, speaking, move)

    def sign(self, form: str, kind: str, article: str = "", means: str = "") -> Record:
        """A word: a form of a kind, as it is said with this article, and its meaning.

        It means what the word `means` does, which may be of another language, or else
        has a meaning of its own.
        """
        meaning = self.meaning((means or form).lower(), kind.capitalize())
        return _sign(form.lower(), kind, article.lower(), meaning)

    def kind_in(self, template: str) -> str | None:
        """The kind of word that has its place in a type of the theory, if one has."""
        return self.derive(_kind_in, template)

    def meaning(self, form: str, template: str) -> RecordType:
        """What a word means in a place: the type with the word's own predicate in it.

        `TypeError` for a type that has no place for a word.
        """
        kind = self._kind_at(template)
        name = predicate_name(form)
        pattern: Pred = self[kind]
        own = Pred(f"is_{name}" if kind == "adjective" else name, *pattern.arities)
        return _in_place(own, self.record_type(template), pattern)

    def meaning_at(self, sign: Record, template: str) -> RecordType:
        """What a sign means in another place: a noun as said of a target, say."""
        pattern = self[self._kind_at(template)]
        return _in_place(word_of(sign), self.record_type(template), pattern)

    def _kind_at(self, template: str) -> str:
        kind = self.kind_in(template)
        if kind is None:
            source = self.theory.source
            raise TypeError(f"{template} of {source} has no place for a word")
        return kind


def any_of(types: DialogueTypes, names: tuple[str, ...]) -> TypeNode:
    """The join of the types of these names."""
    several: TypeNode = join(*(types[name] for name in names))
    return several


def _move_type(types: DialogueTypes, speaking: str, move: str) -> RecordType:
    return merge_of(types.record_type(speaking), types.record_type(move))


def _kind_in(types: DialogueTypes, template: str) -> str | None:
    if template not in types:
        return None
    mentioned = set(_predicates(types.record_type(template)))
    return next((kind for kind in KINDS if types[kind] in mentioned), None)


@lru_cache(4096)
def _sign(form: str, kind: str, article: str, meaning: RecordType) -> Record:
    return record(form=form, kind=kind, article=article, meaning=meaning)


@lru_cache(4096)
def _in_place(own: Pred, template: RecordType, pattern: Pred) -> RecordType:
    """The type with a word's own predicate where one stands for it."""
    placed = _with(template, pattern, own)
    assert isinstance(placed, RecordType)
    return placed


# --- of the packaged theory -----------------------------------------------------------


@cache
def packaged_types() -> DialogueTypes:
    """The types of the packaged `tutor.ttr`.

    >>> print(packaged_types()["Phrase"])
    [look : Look, x : Ind]
    """
    return DialogueTypes(packaged_theory())


def types_of(theory: Theory | DialogueTypes | None) -> DialogueTypes:
    """The types of a theory, by default of the packaged one."""
    match theory:
        case None:
            return packaged_types()
        case DialogueTypes():
            return theory
    return DialogueTypes(theory)


def theory() -> Theory:
    """The packaged theory of the dialogue.

    >>> print(theory()["Phrase"])
    [look : Look, x : Ind]
    """
    return packaged_types().theory


def record_type(name: str) -> RecordType:
    """The record type that the packaged theory gives this name.

    >>> print(record_type("Phrase"))
    [look : Look, x : Ind]
    """
    return packaged_types().record_type(name)


def move_type(speaking: str, move: str) -> RecordType:
    """The type of a move of the packaged theory, as something that is heard or said.

    >>> greeted = move_type("Heard", "Greet")
    >>> greeted <= record_type("Heard"), greeted <= record_type("Greet")
    (True, True)
    """
    return packaged_types().move_type(speaking, move)


def sign(form: str, kind: str, article: str = "", means: str = "") -> Record:
    """A word: a form of a kind, as it is said with this article, and what it means.

    It means what the word `means` does, which may be of another language, or else has a
    meaning of its own.

    >>> print(sign("teddy bear", "noun", "a"))  # doctest: +NORMALIZE_WHITESPACE
    {article = a, form = "teddy bear", kind = noun,
     meaning = [look : Look, x : Ind, c : teddy_bear(x, look)]}
    >>> word_of(sign("röd", "adjective", means="red")).name
    'is_red'
    """
    return packaged_types().sign(form, kind, article, means)


def noun(form: str, article: str = "") -> Record:
    """The sign of a noun.

    >>> print(noun("cup", "a").meaning)
    [look : Look, x : Ind, c : cup(x, look)]
    """
    return sign(form, "noun", article)


def adjective(form: str) -> Record:
    """The sign of an adjective.

    >>> print(adjective("red").meaning)
    [look : Look, x : Ind, a : is_red(x, look)]
    """
    return sign(form, "adjective")


def relation(form: str) -> Record:
    """The sign of a relation, such as "to the left of".

    >>> print(relation("behind").meaning)
    [frame : Front, look : Look, landmark : [look = ^.look : Look, x : Ind], target :
    [look = ^.look : Look, x : Ind], rel : behind(target.x, landmark.x, look, frame)]
    """
    return sign(form, "relation")


def kind_in(template: str) -> str | None:
    """The kind of word that has its place in a type of the theory, if one has.

    >>> kind_in("Naming"), kind_in("Nearby"), kind_in("Phrase")
    ('noun', 'relation', None)
    """
    return packaged_types().kind_in(template)


def meaning_in(form: str, template: str) -> RecordType:
    """What a word means in a place: the type with the word's own predicate in it.

    >>> print(meaning_in("red", "Having"))  # doctest: +NORMALIZE_WHITESPACE
    [look : Look, target : [look = ^.look : Look, x : Ind],
     a : is_red(target.x, look)]
    """
    return packaged_types().meaning(form, template)


def meaning_at(sign: Record, template: str) -> RecordType:
    """What a sign means in another place: a noun as said of a target, for example.

    >>> print(meaning_at(noun("cup"), "Naming"))
    [look : Look, target : [look = ^.look : Look, x : Ind], c : cup(target.x, look)]
    """
    return packaged_types().meaning_at(sign, template)


# --- of any theory --------------------------------------------------------------------


@lru_cache(16384)
def merge_of(S: RecordType, T: RecordType) -> RecordType:
    """The merge of two record types, which is a record type.

    >>> print(merge_of(noun("cup").meaning, adjective("red").meaning))
    [look : Look, x : Ind, a : is_red(x, look), c : cup(x, look)]
    """
    merged = merge(S, T)
    assert isinstance(merged, RecordType)
    return merged


@lru_cache(16384)
def set_to(T: RecordType, **fields: TypeNode) -> RecordType:
    """The record type with some of its fields, or new ones, as they are here.

    >>> from ttr import Ind
    >>> print(set_to(rectype(x=Ind), x=Ind @ "o1"))
    [x = o1 : Ind]
    """
    types = {**dict(T.fields), **fields}
    if all(label in T and _is_set(T[label], to) for label, to in fields.items()):
        return RecordType(tuple(types.items()))
    if all(label not in T and not free_paths(to) for label, to in fields.items()):
        return RecordType(order_fields(types))
    return rectype(types)


def _is_set(field: TypeNode, to: TypeNode) -> bool:
    """Whether a field is only set to an object, so that its paths still fit."""
    base = _unset(to)
    return base is _unset(field) and free_paths(base) == free_paths(to) == free_paths(
        field
    )


def _unset(T: TypeNode) -> TypeNode:
    return _unset(T.base) if isinstance(T, Singleton) else T


@lru_cache(4096)
def predicate_name(form: str) -> str:
    """What the predicate of a word is called: its form as one identifier.

    >>> predicate_name("Can of Paint"), predicate_name("shoe-box"), predicate_name("3D")
    ('can_of_paint', 'shoe_box', 'n3d')
    """
    plain = unicodedata.normalize("NFKC", form.lower())
    name = re.sub(r"\W+", "_", plain).strip("_")
    name = "".join(c if f"n{c}".isidentifier() else f"u{ord(c):x}" for c in name)
    return name if name.isidentifier() else f"n{name}"


def _predicates(T: TypeNode) -> Iterator[Pred]:
    """The predicates of the ptypes in a type."""
    match T:
        case PType(pred, _):
            yield pred
        case RecordType(fields):
            for _, field in fields:
                yield from _predicates(field)
        case Meet(parts):
            for part in parts:
                yield from _predicates(part)
        case Negation(body):
            yield from _predicates(body)


def _with(T: TypeNode, pattern: Pred, own: Pred) -> TypeNode:
    """The type with one predicate in place of another."""
    match T:
        case PType(pred, args) if pred is pattern:
            return own(*args)
        case RecordType(fields):
            return rectype({k: _with(field, pattern, own) for k, field in fields})
        case Meet(parts):
            return meet(*(_with(part, pattern, own) for part in parts))
        case Negation(body):
            return ~_with(body, pattern, own)
        case Singleton(base, value):
            return Singleton(_with(base, pattern, own), value)
    return T


def word_of(sign: Record) -> Pred:
    """The predicate that is a sign's own: the one that its meaning mentions.

    >>> print(word_of(noun("teddy bear")), word_of(adjective("red")))
    teddy_bear is_red
    """
    own = _first_predicate(sign.meaning)
    if own is None:
        raise TypeError(f"the meaning of {sign.form!r} has no predicate of its own")
    return own


@lru_cache(4096)
def _first_predicate(T: RecordType) -> Pred | None:
    return next(_predicates(T), None)


def replace_word(T: RecordType, sign: Record, other: Record) -> RecordType:
    """The type with what one word means in place of what another of its kind does.

    >>> print(replace_word(noun("cupp").meaning, noun("cupp"), noun("cup")))
    [look : Look, x : Ind, c : cup(x, look)]
    """
    changed = _with(T, word_of(sign), word_of(other))
    assert isinstance(changed, RecordType)
    return changed


def mentions(T: TypeNode, sign: Record) -> bool:
    """Whether the sign's predicate occurs in a type.

    >>> content = meaning_in("cup", "Naming")
    >>> mentions(content, noun("cup")), mentions(content, noun("mug"))
    (True, False)
    """
    return word_of(sign) in _all_predicates(T)


@lru_cache(4096)
def _all_predicates(T: TypeNode) -> frozenset[Pred]:
    return frozenset(_predicates(T))


CLAIMS = ("c", "a", "rel")
"""The labels under which the claim of a sentence stands: what its word is true of.

>>> from kille.dialogue.meanings import CLAIMS, noun
>>> [label for label in CLAIMS if label in noun("cup").meaning]
['c']
"""


ALSO = "also"
"""The label of what else a content claims: several things said in one breath."""


def join_claims(content: RecordType, *others: RecordType) -> RecordType:
    """The content that makes the claims of several, each of its own thing."""
    if not others:
        return content
    return set_to(content, **{ALSO: join_claims(*others)})


def single_claims(content: RecordType) -> tuple[RecordType, ...]:
    """The contents that a content is joined of, in order; itself if it is single.

    >>> cup, mug = meaning_in("cup", "Naming"), meaning_in("mug", "Naming")
    >>> single_claims(join_claims(cup, mug)) == (cup, mug)
    True
    """
    others = content.get(ALSO)
    if not isinstance(others, RecordType):
        return (content,)
    first = rectype({label: T for label, T in content.fields if label != ALSO})
    return (first, *single_claims(others))


def denial(content: RecordType) -> RecordType:
    """The content that denies the claim of a content, or claims what it denies.

    >>> print(denial(meaning_in("cup", "Noun")))
    [look : Look, x : Ind, c : ~cup(x, look)]
    """
    claims = {label: content[label] for label in CLAIMS if label in content}
    return set_to(content, **{label: _not(claim) for label, claim in claims.items()})


def _not(claim: TypeNode) -> TypeNode:
    return claim.body if isinstance(claim, Negation) else ~claim


def claims(content: RecordType, sign: Record) -> bool:
    """Whether a sign is the word that a content is the claim of.

    >>> content = meaning_in("cup", "Naming")
    >>> claims(content, noun("cup")), claims(content, noun("mug"))
    (True, False)
    """
    return any(word_of(sign) in set(_predicates(it)) for it in _claims(content))


@lru_cache(4096)
def claimed_words(content: RecordType) -> frozenset[Pred]:
    """The predicates of the words that a content is the claim of."""
    return frozenset(pred for it in _claims(content) for pred in _predicates(it))


def _claims(content: RecordType) -> Iterator[TypeNode]:
    for label in CLAIMS:
        if label in content:
            yield content[label]


def is_denial(content: RecordType) -> bool:
    """Whether a content says that its word is not true of its target.

    >>> content = meaning_in("cup", "Naming")
    >>> is_denial(content), is_denial(denial(content))
    (False, True)
    """
    return any(isinstance(claim, Negation) for claim in _claims(content))


def set_at(T: RecordType, path: str, value: Object) -> RecordType:
    """The record type with the field at a path made manifest, or set anew.

    >>> print(set_at(record_type("Asked"), "target.x", "o2"))
    [look : Look, target : [look = ^.look : Look, x = o2 : Ind]]
    """
    label, _, rest = path.partition(".")
    field = T[label]
    if rest:
        if not isinstance(field, RecordType):
            raise TypeError(f"the field {label} of {T} is no record type")
        return set_to(T, **{label: set_at(field, rest, value)})
    base = field.base if isinstance(field, Singleton) else field
    return set_to(T, **{label: base @ value})


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


def values_at(T: RecordType, label: str) -> tuple[Object, ...]:
    """What a field for a list is set to; nothing where it is not set.

    A rule of one's own may plan a move and leave open what the robot does thereby.

    >>> from ttr import Ind, ListOf
    >>> values_at(rectype(x=ListOf(Ind) @ ("o1", "o2")), "x")
    ('o1', 'o2')
    >>> values_at(rectype(x=ListOf(Ind)), "x")
    ()
    """
    field = T[label]
    found = field.value if isinstance(field, Singleton) else ()
    return found if isinstance(found, tuple) else ()


def predicate_at(T: RecordType, label: str) -> Pred:
    """The predicate of the ptype that a field has.

    >>> print(predicate_at(noun("cup").meaning, "c"))
    cup
    """
    field = T[label]
    if isinstance(field, PType):
        return field.pred
    raise TypeError(f"the field {label} of {T} is no ptype")
