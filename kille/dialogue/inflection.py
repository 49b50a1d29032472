"""Forms of words, both ways: from a word to its form, and back from a form to words.

For every form the lexicon of a language lists the irregular words and the endings of
the others, and for every article how the words begin or end that take it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Inflection:
    """One form of a kind of words, such as the plural of nouns.

    Of several words the last one is inflected, or the one before a complement.

    >>> plural = Inflection(
    ...     irregular={"mouse": ("mice",)},
    ...     endings=(("ey", "eys"), ("y", "ies"), ("x", "xes"), ("", "s")),
    ...     complements=frozenset({"of"}),
    ... )
    >>> [plural.of(word) for word in ("mouse", "key", "shoe-box", "can of paint")]
    ['mice', 'keys', 'shoe-boxes', 'cans of paint']
    >>> plural.words("boxes"), plural.words("mice"), plural.words("cans of paint")
    (('box', 'boxe'), ('mouse',), ('can of paint',))
    """

    irregular: Mapping[str, tuple[str, ...]]
    """The forms of words that go otherwise: the first is said, all are understood."""
    endings: tuple[tuple[str, str], ...]
    complements: frozenset[str] = frozenset()
    article: str = ""
    """The article of the words that have these endings; "" if any has them."""
    _regained: Mapping[str, tuple[str, ...]] = field(init=False)

    def __post_init__(self) -> None:
        regained: dict[str, tuple[str, ...]] = {}
        for word, forms in self.irregular.items():
            for form in forms:
                regained[form] = (*regained.get(form, ()), word)
        object.__setattr__(self, "_regained", regained)

    def of(self, word: str) -> str:
        """The form of a word."""
        before, head, after = self._split_at_head(word)
        return f"{before}{self._of(head)}{after}"

    def words(self, form: str) -> tuple[str, ...]:
        """The words that a form may belong to; an irregular form has only its own."""
        before, head, after = self._split_at_head(form)
        return tuple(f"{before}{word}{after}" for word in self._words(head))

    def _of(self, word: str) -> str:
        if word in self.irregular:
            return self.irregular[word][0]
        for ending, new in self.endings:
            if word.endswith(ending) and word != ending:
                return word[: len(word) - len(ending)] + new
        return word

    def _words(self, form: str) -> tuple[str, ...]:
        if form in self._regained:
            return self._regained[form]
        found = (
            form[: len(form) - len(new)] + ending
            for ending, new in sorted(
                self.endings, key=lambda it: (-len(it[1]), len(it[0]))
            )
            if form.endswith(new)
        )
        return tuple(dict.fromkeys(it for it in found if it and self._of(it) == form))

    def _split_at_head(self, word: str) -> tuple[str, str, str]:
        """What stands before the word that is changed, that word, and the rest."""
        several = word.split(" ")
        at = next(
            (n for n, it in enumerate(several) if n and it in self.complements),
            len(several),
        )
        before, after = several[: at - 1], several[at:]
        return (
            "".join(f"{it} " for it in before),
            several[at - 1],
            "".join(f" {it}" for it in after),
        )


@dataclass(frozen=True)
class Articles:
    """Which indefinite article a word has, by how it begins or ends.

    Of all beginnings and endings that fit, the longest decides.

    >>> english = Articles({"a": ["", "uni"], "an": ["a", "e", "i", "o", "u"]}, {})
    >>> english.of("cup"), english.of("umbrella"), english.of("unicorn")
    ('a', 'an', 'a')
    """

    beginnings: Mapping[str, Iterable[str]]
    endings: Mapping[str, Iterable[str]]
    open_: tuple[str, ...] = ("",)
    """Beginnings of words whose article the tutor may know better: "an hotel"."""

    def choose(self, word: str, article: str) -> str:
        """The article of a word: the one that the tutor used where that may be right.

        Of several words, such as "a pair of", it is none that a form decides.

        >>> english = Articles({"a": ["", "uni"], "an": ["a", "e"]}, {}, ("h", "u"))
        >>> english.choose("hotel", "an"), english.choose("apple", "a")
        ('an', 'an')
        >>> english.choose("boots", "a pair of")
        'a pair of'
        """
        knows = " " in article or (article and word.startswith(self.open_))
        return article if knows and not self.has(word) else self.of(word)

    def has(self, word: str) -> bool:
        """Whether the article of a word is settled: it is listed as a whole.

        >>> Articles({}, {"ett": ["bord"]}).has("bord")
        True
        """
        return any(word in parts for parts in self.endings.values())

    def of(self, word: str) -> str:
        """The article of a word."""
        fitting = [
            (len(part), article)
            for table, fits in (
                (self.beginnings, word.startswith),
                (self.endings, word.endswith),
            )
            for article, parts in table.items()
            for part in parts
            if fits(part)
        ]
        return max(fitting, key=lambda it: it[0], default=(0, ""))[1]
