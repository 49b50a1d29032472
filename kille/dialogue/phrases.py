"""From what a noun phrase means to its words: the reverse of parsing one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from kille.dialogue.lexicon import Lexicon
from ttr import Pred, Record, RecordType
from ttr.types import Join, Meet, Negation, PType, Singleton, TypeNode

Words = Mapping[Pred, Record]
"""The sign of each predicate that is a word."""


def phrase(lexicon: Lexicon, part: RecordType, words: Words, style: str) -> str | None:
    """The noun phrase for a part of a content, in one style of the lexicon.

    None if there is no word for it.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import adjective, noun, word_of
    >>> from ttr import merge
    >>> red, cup = adjective("red"), noun("cup")
    >>> words = {word_of(sign): sign for sign in (red, cup)}
    >>> phrase(lexicon(), merge(red.meaning, cup.meaning), words, "definite")
    'the red cup'
    """
    nouns = [it for it in _predicates(part, "c") if it in words]
    own = [words[it] for it in _predicates(part, "a") if it in words]
    talk = [it.name for it in _discourse(part)]
    beside = place_words(lexicon, part, words)
    marking = [name for name in talk if name in lexicon.marking]
    alone = [lexicon.referring[name] for name in talk if name in lexicon.referring]
    if not (nouns or own or marking or alone or beside):
        number = part.get("number")
        return f"#{number.value}" if isinstance(number, Singleton) else None
    if alone and not (nouns or own or marking):
        core = alone[0]
    else:
        pointing = [name for name in talk if name in lexicon.styles]
        style = pointing[0] if pointing and style == "definite" else style
        has_own = [name for name in marking if f"{style}_{name}" in lexicon.styles]
        marked = [lexicon.marking[name] for name in marking if name not in has_own]
        style = f"{style}_{has_own[0]}" if has_own else style
        core = _core(lexicon, words[nouns[0]] if nouns else None, own, marked, style)
    return f"{core} {beside}" if beside else core


def noun_phrase(lexicon: Lexicon, noun: Record, style: str) -> str:
    """The noun phrase of a noun alone, in one style of the lexicon.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import noun
    >>> noun_phrase(lexicon("sv"), noun("bok"), "definite")
    'boken'
    """
    return _core(lexicon, noun, [], [], style)


def _core(
    lexicon: Lexicon,
    noun: Record | None,
    adjectives: list[Record],
    marked: list[str],
    style: str,
) -> str:
    """Noun and adjectives by the template of a style that fits what is there."""
    has = lexicon.styles[style]
    article = lexicon.article(noun) if noun is not None else ""
    materials = [it for one in adjectives if (it := lexicon.say_material(one.form))]
    described = [
        *marked,
        *(
            lexicon.inflect(it.form, has.at("adjective", article), article)
            for it in adjectives
            if not lexicon.say_material(it.form)
        ),
        *(materials if noun is None else ()),
    ]
    match noun is not None, bool(described):
        case True, True:
            name = "described"
        case True, False:
            name = "named"
        case False, True:
            name = "nameless"
        case _:
            name = "placed"
    form = noun.form if noun is not None else ""
    inflected = lexicon.inflect(form, has.at("noun", article), article)
    first = described[0] if described else form
    core = has.at(name, article).format(
        noun=inflected,
        adjectives=" ".join(described),
        article=_indefinite(lexicon, noun, first),
    )
    return " ".join((core, *(materials if noun is not None else ())))


def _indefinite(lexicon: Lexicon, noun: Record | None, first: str) -> str:
    """The indefinite article before the first word of a phrase.

    It goes by that word where articles go by sound, else by the noun.
    """
    own = lexicon.article(noun) if noun is not None else ""
    if noun is None or (first != noun.form and lexicon.articles.beginnings):
        return own if " " in own else lexicon.articles.of(first)
    return own


def place_words(lexicon: Lexicon, part: RecordType, words: Words) -> str | None:
    """The words of a phrase for where its thing is."""
    landmark = part.get("landmark")
    if "b" in part and isinstance(landmark, RecordType):
        return _between(lexicon, landmark, words)
    relation = next((it for it in _predicates(part, "rel") if it in words), None)
    if relation is None or not isinstance(landmark, RecordType):
        return None
    named = phrase(lexicon, landmark, words, "definite")
    return f"{words[relation].form} {named}" if named else None


def _between(lexicon: Lexicon, flank: RecordType, words: Words) -> str | None:
    """The words for being between two things, as far as there are any."""
    other = flank.get("landmark")
    listing = lexicon.sections["listing"]
    one = phrase(lexicon, flank, words, "definite")
    two = None
    if isinstance(other, RecordType):
        two = phrase(lexicon, other, words, "definite")
    if one and two:
        return str(listing["amid"].format(one, two))
    several = phrase(lexicon, flank, words, "counted")
    return str(listing["amid_both"].format(several)) if several else None


def claimed_predicates(field: TypeNode | None) -> Iterator[Pred]:
    """The predicates that a field says, or denies, to be true."""
    match field:
        case PType(pred, _):
            yield pred
        case Meet(fields) | Join(fields):
            for one in fields:
                yield from claimed_predicates(one)
        case Negation(body):
            yield from claimed_predicates(body)


def _predicates(part: RecordType, label: str) -> Iterator[Pred]:
    return claimed_predicates(part.get(label))


def _discourse(part: RecordType) -> Iterator[Pred]:
    """What a phrase says of how its thing stands in the talk: shown, the other …"""
    for label, field in part.fields:
        if label not in ("c", "a", "rel") and isinstance(field, PType | Meet):
            yield from claimed_predicates(field)
