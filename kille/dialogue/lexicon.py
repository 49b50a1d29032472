"""What is known of a language besides its grammar: wordings, forms of words, articles.

All of it is read from `grammars/lexicon.*.toml`; the comments there say what is what.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain
from typing import Any

from kille.dialogue.inflection import Articles, Inflection
from kille.dialogue.language_files import FILES, last_change, read_table
from kille.dialogue.word_lists import word_lists
from ttr import Record

VARIED = "varied"
"""The set of wordings in which the robot says the same in several ways."""

Wordings = Mapping[str, tuple[str, ...]]
"""The sentences for each act; the first of which all slots can be filled is used."""


@dataclass(frozen=True)
class Style:
    """How noun phrases are built in one way: definite, indefinite …

    `noun` and `adjective` name the forms that the words have in it; templates and forms
    may differ by the noun's article.
    """

    templates: Mapping[str, str | Mapping[str, str]]

    def at(self, name: str, article: str) -> str:
        """The template or form of this name for nouns of this article, or nothing."""
        found = self.templates.get(name, "")
        if isinstance(found, str):
            return found
        return found.get(article, "")


@dataclass(frozen=True)
class Lexicon:
    """The lexicon of a language."""

    language: str
    says: Wordings
    tells: Wordings
    varied: Wordings
    """Other sentences for acts, where the robot does not always use the same one."""
    examples: tuple[str, ...]
    not_understood: tuple[str, ...]
    not_understood_beside: tuple[str, ...]
    """The same of a sentence beside others that were understood."""
    pointing: str
    answering: str
    articles: Articles
    inflections: Mapping[str, tuple[Inflection, ...]]
    main_forms: Mapping[str, str]
    means: Mapping[str, str]
    referring: Mapping[str, str]
    values: Mapping[str, str]
    complements: frozenset[str]
    """Words after which a noun of several words has no ending: the "of" in it."""
    sayings: re.Pattern[str] | None
    marking: Mapping[str, str]
    common_gender: str
    """An expression for what an adjective beside it is not neuter of, if any."""
    adjectives: str
    """An expression for words that are adjectives by how they end, if any."""
    definite_nouns: str
    """An expression for words that are definite nouns if they are no adjectives."""
    made_of: str
    """How it is said of what a thing is made: "av {}"; "" where it is as other ways."""
    joins_compounds: bool
    """Whether two nouns that are written apart are one word."""
    styles: Mapping[str, Style]
    vocabulary: frozenset[str]
    """The words in the lexicon itself."""
    sections: Mapping[str, Any]
    """The whole file, for modules with wordings of their own."""

    @property
    def wordings(self) -> Wordings:
        """All sentences for each act, those of every set of wordings."""
        named = self.sections.items()
        sets = [it for name, it in named if name.startswith("says") or name == VARIED]
        acts = dict.fromkeys(act for one in sets for act in one)
        return {
            act: tuple(
                dict.fromkeys(w for one in sets for w in _several(one.get(act, [])))
            )
            for act in acts
        }

    def is_saying(self, text: str) -> bool:
        """Whether a text, in small letters without punctuation, is a saying.

        >>> lexicon().is_saying("that's a good question")
        True
        """
        return self.sayings is not None and bool(self.sayings.fullmatch(text))

    def article(self, sign: Record) -> str:
        """The indefinite article of a word: as the tutor used it, or by its form."""
        return self.articles.choose(sign.form, sign.article)

    def with_article(self, noun: str, article: str = "") -> str:
        """The noun with its indefinite article.

        >>> english = lexicon()
        >>> english.with_article("apple"), english.with_article("unicorn")
        ('an apple', 'a unicorn')
        >>> lexicon("sv").with_article("äpple")
        'ett äpple'
        """
        return f"{self.articles.choose(noun, article)} {noun}"

    def inflect(self, form: str, name: str, article: str = "") -> str:
        """The form of this name of a word, or the word if it has none."""
        kinds = self.inflections.get(name, ())
        for inflection in kinds:
            if inflection.article in ("", article):
                return inflection.of(form)
        return form

    def predicative_form(self, adjective: str, article: str) -> str:
        """The form of an adjective that is said of a noun with this article."""
        form = self.styles["predicative"].at("adjective", article)
        return self.say_material(adjective) or self.inflect(adjective, form, article)

    def say_material(self, adjective: str) -> str:
        """How it is said that a thing is made of this, or nothing if it is no material.

        >>> lexicon("sv").say_material("läder"), lexicon("sv").say_material("röd")
        ('av läder', '')
        """
        if self.made_of and adjective in word_lists(self.language).materials:
            return self.made_of.format(adjective)
        return ""

    def with_examples(self, wording: str) -> str:
        """A wording with what the tutor may say in place of {examples}."""
        return wording.replace("{examples}", "\n  ".join(self.examples))

    def main_form(self, form: str) -> str:
        """The form by which a word is known: "left of" is "to the left of"."""
        return self.main_forms.get(form, form)


def lexicon(language: str = "en", wording: str = "paper") -> Lexicon:
    """The lexicon of a language, with the wordings of one set.

    The section `says_NAME` has the wordings of a set; `says` has those of all sets. The
    set `varied` has those of `says`, and beside them those of the section `varied`.
    """
    return _lexicon(language, wording, last_change(FILES[1], language))


@lru_cache
def _lexicon(language: str, wording: str, _: int) -> Lexicon:
    data = read_table("lexicon.{}.toml", language)
    understands, phrases, articles = (
        data["understands"],
        data["phrases"],
        data["articles"],
    )
    forms, complements = data["inflection"], phrases["complements"]
    inflections = {
        name: tuple(_inflections(forms[table.get("like", name)], complements))
        for name, table in forms.items()
    }
    says = data["says"] | data.get(f"says_{wording}", {})
    return Lexicon(
        language=language,
        says={act: _several(it) for act, it in says.items()},
        tells={act: _several(it) for act, it in data["tutor"].items()},
        varied={
            act: _several(it)
            for act, it in data.get(VARIED, {}).items()
            if wording == VARIED
        },
        examples=tuple(understands["examples"]),
        not_understood=_several(understands["not_understood"]),
        not_understood_beside=_several(
            understands.get("not_understood_beside", understands["not_understood"])
        ),
        pointing=understands["pointing"],
        answering=understands["answering"],
        articles=Articles(
            articles.get("beginnings", {}),
            articles.get("endings", {}),
            tuple(articles.get("open", [""])),
        ),
        inflections=inflections,
        main_forms={
            variant: form
            for form, variants in data["variants"].items()
            for variant in variants
        },
        means=data["means"],
        referring=phrases["referring"],
        values=data.get("values", {}),
        complements=frozenset(complements),
        sayings=_any_of(data.get("sayings", {}).get("patterns", ())),
        marking=phrases["marking"],
        common_gender=phrases.get("common_gender", ""),
        adjectives=phrases.get("adjectives", ""),
        definite_nouns=phrases.get("definite_nouns", ""),
        made_of=phrases.get("made_of", ""),
        joins_compounds=phrases.get("joins_compounds", False),
        styles={
            name: Style(table)
            for name, table in phrases.items()
            if isinstance(table, dict) and name not in ("referring", "marking")
        },
        vocabulary=frozenset(
            chain(
                data["means"],
                *articles.get("endings", {}).values(),
                *(one.irregular for some in inflections.values() for one in some),
            )
        ),
        sections=data,
    )


def _any_of(patterns: Iterable[str]) -> re.Pattern[str] | None:
    """One expression for several, or None for none."""
    some = tuple(patterns)
    return re.compile("|".join(f"(?:{it})" for it in some)) if some else None


def _several(one_or_more: str | list[str]) -> tuple[str, ...]:
    return (one_or_more,) if isinstance(one_or_more, str) else tuple(one_or_more)


def _endings(rows: Iterable[Sequence[str]]) -> Iterator[tuple[str, str]]:
    """Pairs of endings; a third text lists the letters of which one stands before."""
    for ending, new, *before in rows:
        for letter in before[0] if before else ("",):
            yield letter + ending, letter + new


def _inflections(
    table: Mapping[str, Any], complements: Iterable[str]
) -> Iterable[Inflection]:
    """The inflections of one form: one for all words, or one for each article."""
    tables = {"": table} if "endings" in table else table
    for article, one in tables.items():
        yield Inflection(
            irregular={
                word: _several(forms)
                for word, forms in one.get("irregular", {}).items()
            },
            endings=tuple(_endings(one["endings"])),
            complements=frozenset(complements),
            article=article,
        )
