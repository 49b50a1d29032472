"""The lexicon of the fragment: a theory whose lists of words name its predicates."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from ttr.errors import TTRError, suggestion
from ttr.theories.theory import Theory, load
from ttr.types.syntax import Ind, Pred, Type, TypeNode

_UNARY: tuple[TypeNode, ...] = (Ind,)
_BINARY: tuple[TypeNode, ...] = (Ind, Ind)
_OF_PROPERTY: tuple[TypeNode, ...] = (Ind, Ind >> Type)

_CLASSES: dict[str, tuple[str, tuple[TypeNode, ...] | None]] = {
    "nouns": ("NOUN", _UNARY),
    "names": ("NAME", None),
    "intersectives": ("ADJ", _UNARY),
    "subsectives": ("MODADJ", _OF_PROPERTY),
    "privatives": ("NEGADJ", _OF_PROPERTY),
    "intensifiers": ("INTENSIFIER", _OF_PROPERTY),
    "intransitives": ("IV", _UNARY),
    "transitives": ("TV", _BINARY),
    "adverbs": ("ADVERB", _OF_PROPERTY),
    "modals": ("MODAL", _OF_PROPERTY),
    "attitudes": ("ATTITUDE", _OF_PROPERTY),
    "prepositions": ("PREP", _BINARY),
}
"""The lists of a lexicon, each with its terminal and the arity of its predicates."""

_PLURAL = {"nouns"}
_VERBS = {"intransitives", "transitives"}


@dataclass(frozen=True)
class LexicalEntry:
    """A word: its class, its forms, and the predicate (or the object) it stands for."""

    terminal: str
    forms: tuple[str, ...]
    meaning: Pred | str


@dataclass(frozen=True, eq=False)
class Lexicon:
    """Words by class, and the theories that say what they mean.

    >>> from ttr.semantics.fragment import english
    >>> words = english()
    >>> print(words.meaning("NOUN", "dogs"), "dog" in words.forms)
    dog True
    """

    words: Mapping[str, Mapping[str, LexicalEntry]]
    theories: tuple[Theory, ...]

    def word(self, terminal: str, form: str) -> LexicalEntry:
        """The word of a class with this form, however that is spaced or capitalised.

        Raises `TTRError` for a class or a form that the lexicon does not have.
        """
        known = self.words.get(terminal)
        if known is None:
            raise TTRError(
                f"no class of words is called {terminal!r}",
                hint=f"they are {', '.join(self.words)}",
            )
        plain = _normalise_form(form)
        if plain not in known:
            raise TTRError(
                f"no {terminal} of the lexicon has the form {form!r}",
                hint=suggestion(plain, known),
            )
        return known[plain]

    def meaning(self, terminal: str, form: str) -> Pred:
        """The predicate of a word; raises `TTRError` as `word` does, and for a name."""
        found = self.word(terminal, form).meaning
        if isinstance(found, str):
            raise TTRError(f"{form} is a name, and has no predicate")
        return found

    @property
    def forms(self) -> Iterator[str]:
        """Each form of each word."""
        for words in self.words.values():
            yield from words

    @property
    def theory(self) -> Theory:
        """The theory to make models of: all that its theories say of their types."""
        if len(self.theories) == 1:
            return self.theories[0]
        return Theory(
            axioms=tuple(axiom for one in self.theories for axiom in one.axioms),
            opened=frozenset().union(*(one.opened for one in self.theories)),
            givens=tuple(given for one in self.theories for given in one.givens),
            objects=frozenset().union(*(one.objects for one in self.theories)),
            exclusions=tuple(it for one in self.theories for it in one.exclusions),
        )

    def extend(
        self,
        path: str | os.PathLike[str],
        *,
        allow: Iterable[str | os.PathLike[str]] = (),
    ) -> Lexicon:
        """The lexicon with the words of one more file; its own words go first.

        `allow` is as in `ttr.load`.
        """
        return lexicon(*self.theories, load(path, allow=allow))


@cache
def english() -> Lexicon:
    """The lexicon that comes with the fragment, `grammars/fragment.en.ttr`.

    >>> english().meaning("NOUN", "dog")
    Pred('dog', Basic('Ind'))
    """
    return lexicon(_read_shipped_theory())


def _read_shipped_theory() -> Theory:
    text = files("ttr.grammars").joinpath("fragment.en.ttr").read_text("utf-8")
    return Theory.parse(text, "fragment.en.ttr")


def lexicon_of(words: object) -> Lexicon:
    """The lexicon that was given; for None the one that comes with the fragment."""
    if words is None:
        return english()
    if isinstance(words, Lexicon):
        return words
    raise TTRError(
        f"expected a lexicon, found {words!r}", hint="make one with lexicon(theory)"
    )


def lexicon(*theories: Theory) -> Lexicon:
    """The lexicon of theories with lists of words, as in `nouns := ["dog", "cat"]`.

    Raises `TTRError` for a list that holds no words, and for a word whose predicate or
    object the theories do not declare.

    >>> words = lexicon(Theory.parse('''
    ...     basic Ind
    ...     pred dog(Ind)
    ...     nouns := ["dog"]
    ... '''))
    >>> words.meaning("NOUN", "Dogs")
    Pred('dog', Basic('Ind'))
    """
    for theory in theories:
        if not isinstance(theory, Theory):
            raise TTRError(f"a lexicon is made of theories, found {theory!r}")
    words: dict[str, dict[str, LexicalEntry]] = {
        one: {} for one, _ in _CLASSES.values()
    }
    for theory in theories:
        for name, (terminal, arity) in _CLASSES.items():
            for entry in _entries(theory, name):
                word = _word(theories, theory.source, name, terminal, arity, entry)
                for form in word.forms:
                    words[terminal].setdefault(_normalise_form(form), word)
    return Lexicon(words, theories)


def _entries(theory: Theory, name: str) -> Iterator[tuple[str, ...]]:
    """The words of a list of the theory, each as a tuple of its forms."""
    found = theory.definitions.get(name, ())
    for entry in found if isinstance(found, tuple) else (found,):
        forms = entry if isinstance(entry, tuple) else (entry,)
        if not forms or not all(isinstance(it, str) and it.strip() for it in forms):
            raise TTRError(
                f"{theory.source}: {name} is a list of words, each a text or a list of "
                f"texts, but has {entry!r}"
            )
        yield tuple([str(form) for form in forms])


def _word(
    theories: tuple[Theory, ...],
    source: str,
    name: str,
    terminal: str,
    arity: tuple[TypeNode, ...] | None,
    forms: tuple[str, ...],
) -> LexicalEntry:
    base = re.sub(r"\W+", "_", forms[0].strip().lower())
    if arity is None:
        if any(base in theory.objects for theory in theories):
            return LexicalEntry(terminal, forms, base)
        raise TTRError(
            f"{source}: names has {forms[0]}, but no object {base} is declared",
            hint=f"write: object {base} : Ind",
        )
    pred = _predicate(theories, base) or _predicate(theories, f"{base}_")
    if pred is None or arity not in pred.arities:
        known = (name for theory in theories for name in theory.predicates)
        wanted = f"{base}({', '.join(map(str, arity))})"
        raise TTRError(
            f"{source}: {name} has {forms[0]}, but no predicate {wanted} is declared",
            hint=suggestion(base, known) if pred is None else "",
        )
    return LexicalEntry(terminal, (*forms, *_regular_forms(name, forms[0])), pred)


def _predicate(theories: Iterable[Theory], name: str) -> Pred | None:
    return next((it.predicates[name] for it in theories if name in it.predicates), None)


def _regular_forms(name: str, base: str) -> tuple[str, ...]:
    """The regular forms: the plural of a noun, third person and past of a verb."""
    if name in _PLURAL:
        return (_with_s(base),)
    if name not in _VERBS:
        return ()
    head, space, rest = base.partition(" ")
    past = f"{head}d" if head.endswith("e") else f"{head}ed"
    if re.search(r"[^aeiou]y$", head):
        past = f"{head[:-1]}ied"
    return tuple(form + space + rest for form in (_with_s(head), past))


def _with_s(word: str) -> str:
    if re.search(r"[^aeiou]y$", word):
        return f"{word[:-1]}ies"
    return f"{word}es" if re.search(r"(s|x|z|ch|sh)$", word) else f"{word}s"


def _normalise_form(form: str) -> str:
    return " ".join(form.replace("’", "'").lower().split())
