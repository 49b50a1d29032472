"""Which words a tutor may say of a thing without being asked whether they mean it.

The lists are in `grammars/words.*.toml`; sayings are in the lexicon. A word that the
robot knows is never asked about: the lists are only for new ones.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import lru_cache

from kille.dialogue.language_files import WORDS, last_change, read_table
from kille.dialogue.typos import is_misspelling

REMARK, DOUBTFUL, SAYING, PARTIAL = "remark", "doubtful", "saying", "partial"
NAME, CUT_OFF = "name", "cut off"
CONTRADICTORY = "contradictory"
"""What a new word of a lesson may be: no word for a thing at all, or perhaps none.

A saying is one as a whole, whatever its words are. What is partial is read from a part
of a sentence, or perhaps not meant so. A name is that of one thing or person; of a word
that is cut off the speaker has said only the beginning.
"""

_PLAIN = re.compile(r"[^\w'’-]+")


@dataclass(frozen=True)
class WordLists:
    """The lists of a language; without any, no word is asked about."""

    abstract: frozenset[str] = frozenset()
    doubtful: frozenset[str] = frozenset()
    qualities: frozenset[str] = frozenset()
    things: frozenset[str] = frozenset()
    """Common nouns for things: new words may be slips of them."""
    materials: frozenset[str] = frozenset()
    """Nouns for what things are made of, which also say how these are."""
    quality_endings: tuple[str, ...] = ()
    """How words end that say how things are, whatever stands before: "-coloured"."""
    evaluations: frozenset[str] = frozenset()
    """Words for how good or true it is what was said: no qualities of things."""
    endings: tuple[str, ...] = ()
    parts: frozenset[str] = frozenset()
    """Nouns for what things have, such as handles."""
    aspects: frozenset[str] = frozenset()
    """Nouns for how things are as a whole: no parts of them."""
    harmless: frozenset[tuple[str, ...]] = frozenset()
    """Words and phrases that may be left out of a sentence without a change."""
    fillers: frozenset[str] = frozenset()
    """Words that are never learned, and harmless everywhere: hesitation, "sorry"."""
    joining: frozenset[str] = frozenset()
    """Words that join clauses: "and", "but"."""
    closed: frozenset[str] = frozenset()
    """Words that are no nouns or adjectives where only a part of a sentence is read."""
    unreal: frozenset[tuple[str, ...]] = frozenset()
    """Words and phrases beside which nothing is claimed: "if", "looks like".

    A word with a ^ before it is one only at the beginning of a sentence.
    """
    repairs: frozenset[tuple[str, ...]] = frozenset()
    """Words between what is said by mistake, and what is said instead."""
    repair: str = ""
    """One of them, as it is written: "i mean"."""
    renewals: frozenset[tuple[str, ...]] = frozenset()
    """Those of them that may begin a sentence of their own: "I mean red!"."""
    swapped: Mapping[str, str] = field(default_factory=dict)
    """Small words with two letters changed about, and how they are written."""
    names: frozenset[str] = frozenset()
    """Names of persons, which are no words for kinds of things."""
    contents: frozenset[str] = frozenset()
    """Words before what something holds or is made of: "of", "with"."""
    articles: frozenset[str] = frozenset()
    negations: frozenset[str] = frozenset()
    auxiliaries: frozenset[str] = frozenset()
    """Verbs of which the words before them are the subject: "a real bear would"."""
    reasons: frozenset[str] = frozenset()
    """Words before a reason: "it is not a bottle because it is green"."""
    addressees: frozenset[str] = frozenset()
    """The words for whom one speaks to: what is said of the robot is no lesson."""
    copulas: frozenset[str] = frozenset()
    """The forms of "be" that say something of a subject, also as endings: "'s"."""
    numbers: tuple[str, ...] = ()
    """The words for one, two, three and so on, in order."""
    spoken: Mapping[str, str] = field(default_factory=dict)
    """Forms that are written as they are spoken, and those of the grammar for them."""
    across: Mapping[str, str] = field(default_factory=dict)
    """Forms that go on over several sentences, and those of the grammar for them."""
    elliptic: Mapping[str, str] = field(default_factory=dict)
    """Forms that leave out a noun, and those with the noun in its place: {a_noun}."""
    opposites: Mapping[str, str] = field(default_factory=dict)
    """Relations, and how things stand that stand the other way round."""
    reversing: str = ""
    """The expression of who says that it is the other way round."""
    reversed: str = ""
    """That in full, where it is known how things stand."""
    sides: Mapping[str, str] = field(default_factory=dict)
    """Forms that only say on which side it is, and those in full: "No, left."."""
    elsewhere: Mapping[str, str] = field(default_factory=dict)
    """The same of forms that say which one it is instead: "No, the other one."."""

    def harmless_runs(self, forms: Sequence[str]) -> Iterator[range]:
        """Where harmless words and phrases stand among these words."""
        return _runs(self.harmless, forms)

    def repair_runs(self, forms: Sequence[str]) -> Iterator[range]:
        """Where among these words their speaker sets right what they have said."""
        return _runs(self.repairs, forms)

    def is_closed(self, form: str) -> bool:
        """Whether a word is no noun or adjective in a part of a sentence."""
        return form in self.closed or form in self.fillers

    def is_phrase(self, forms: Sequence[str]) -> bool:
        """Whether several words say together how a thing is: "worn out"."""
        return len(forms) > 1 and "_".join(forms) in self.qualities

    def has_copula(self, form: str) -> bool:
        """Whether a word is a form of "be", or ends with one: "isn't", "cup's"."""
        _, mark, ending = form.partition("'")
        return form in self.copulas or (bool(mark) and mark + ending in self.copulas)

    def is_unreal(self, forms: Sequence[str]) -> bool:
        """Whether a sentence of these words says what is not, or not for certain."""
        begins = (f"^{forms[0]}",) if forms else ()
        return begins in self.unreal or any(True for _ in _runs(self.unreal, forms))

    def write_out(self, text: str) -> str:
        """The text with forms of the grammar in place of those that are spoken.

        >>> word_lists("sv").write_out("va e dettahär?")
        'vad är det här?'
        >>> word_lists("en").write_out("Thsi is a cup.")
        'this is a cup.'
        """
        words = (self.swapped.get(it.lower(), it) for it in re.split(r"(\W+)", text))
        said = "".join(words)
        written = _replace_forms(said, self.spoken)
        return written if written == said else " ".join(written.split())

    def join_sentences(self, text: str) -> str:
        """The text with what is said over several of its sentences said in one.

        >>> word_lists("en").join_sentences("See the round thing? Apple.")
        'the round thing is an Apple.'
        """
        return _replace_forms(text, self.across)

    def fill_side(self, text: str, relation: str = "") -> str:
        """The text in full, where it only says on which side something is instead.

        So it is if it says that it is the other way round, and how things stand.

        >>> word_lists("en").fill_side("Nope, left.")
        'no, to the left of it.'
        >>> word_lists("en").fill_side("Other way round.", "behind")
        'no, in front of it. '
        """
        if relation in self.opposites and self.reversing:
            full = self.reversed.format(relation=self.opposites[relation])
            text = re.sub(f"(?i:{self.reversing})", full, text)
        return _replace_forms(text, self.sides)

    def fill_noun(
        self, text: str, noun: str, a_noun: str, *, is_elsewhere: bool = False
    ) -> str:
        """The text with a noun where it is left out: what was learned, or pointed out.

        Where how something is was learned, `a_noun` is that, and there is no noun.

        >>> english = word_lists("en")
        >>> english.fill_noun("That's another one.", "key", "a key")
        "That's another key."
        >>> english.fill_noun("No, the left one.", "key", "a key", is_elsewhere=True)
        'no, the left one is a key.'
        """
        elliptic = self.elsewhere if is_elsewhere else self.elliptic
        forms = {
            said: written.format(noun=noun, a_noun=a_noun)
            for said, written in elliptic.items()
            if noun or "{noun}" not in written
        }
        return _replace_forms(text, forms)

    def judge_noun(self, form: str, complements: Iterable[str] = ()) -> str:
        """`REMARK`, `DOUBTFUL` or `PARTIAL` for a noun that may name no thing, or "".

        >>> english = word_lists("en")
        >>> [english.judge_noun(it) for it in ("cup", "idea", "wug", "king")]
        ['', 'remark', '', 'doubtful']
        >>> english.judge_noun("question of taste", ["of"])
        'remark'
        """
        form = form.replace(" ", "_")
        words = form.split("_")
        head = _head(form, complements)
        if form in self.names:
            return NAME
        if words[-1].isdigit():
            return REMARK
        if len(words) > 1 and form in self.things:
            return ""  # "pencil case"
        if form in self.abstract or head in self.abstract or is_noise(form):
            return REMARK
        if head.endswith(self.endings):
            return REMARK
        if len(form) == 1 and self.abstract:
            return DOUBTFUL
        if head != words[-1] and head in self.parts:
            return DOUBTFUL  # "a crack in the cup"
        if head != words[-1] and self.contents.isdisjoint(words):
            return PARTIAL  # "a recipe for disaster"
        if words[0] in self.doubtful and len(words) > 1:
            return DOUBTFUL
        return DOUBTFUL if form in self.doubtful or head in self.doubtful else ""

    def judge_part(self, form: str, complements: Iterable[str] = ()) -> str:
        """`REMARK` or `PARTIAL` for a noun that may be no part of a thing, or "".

        >>> english = word_lists("en")
        >>> parts = ("handle", "big handle", "nice colour", "idea", "blorp")
        >>> [english.judge_part(it) for it in parts]
        ['', '', 'remark', 'remark', 'partial']
        """
        head = _head(form.replace(" ", "_"), complements)
        if head in self.parts:
            return ""
        if head in self.aspects:
            return REMARK
        judged = self.judge_noun(form, complements)
        if judged in (REMARK, NAME):
            return judged
        return PARTIAL if self.parts else ""

    def judge_quality(self, form: str) -> str:
        """The same of a word that is said without an article: "this is sugar".

        >>> english = word_lists("en")
        >>> [english.judge_quality(it) for it in ("light blue", "sugar", "life")]
        ['', 'doubtful', 'remark']
        >>> english.judge_quality("wrong")
        'remark'
        """
        if not self.qualities:
            return ""
        words = form.split()
        if self.is_phrase(words):
            return ""
        if not self.evaluations.isdisjoint(words):
            return REMARK
        if all(map(self._is_quality, words)):
            return ""
        if form in self.names:
            return NAME
        if is_noise(form):
            return REMARK
        return REMARK if words[-1] in self.abstract else DOUBTFUL

    def names_quality(self, form: str) -> bool:
        """Whether a word by itself says how a thing is, or of what, and not what.

        >>> english = word_lists("en")
        >>> [english.names_quality(it) for it in ("soft", "leather", "cup", "wug")]
        [True, True, False, False]
        >>> [english.names_quality(it) for it in ("good", "three")]
        [False, False]
        """
        if form in self.things or form in self.evaluations or form in self.numbers:
            return False
        return self._is_quality(form) or form in self.materials

    def intended_word(self, form: str, kind: str) -> tuple[str, str, str] | None:
        """The common word that a new one may be a slip of: its form, kind and article.

        None if there is not just one, or if the word is one of the lists itself.

        >>> english = word_lists("en")
        >>> [english.intended_word(it, "noun") for it in ("botle", "cpu", "cup", "wug")]
        [('bottle', 'noun', ''), ('cup', 'noun', ''), None, None]
        >>> english.intended_word("mettal", "adjective")
        ('metal', 'adjective', '')
        >>> english.intended_word("acap", "adjective")
        ('cap', 'noun', 'a')
        """
        if " " in form or self._is_word(form):
            return None
        common = self.things if kind == "noun" else self.qualities | self.materials
        found = [it for it in common if is_misspelling(form, it)]
        found = found or [*self._compounds_near(form)] if kind == "noun" else found
        if not found and kind == "adjective":
            return self._run_together(form)
        return (found[0], kind, "") if len(found) == 1 else None

    def _compounds_near(self, form: str) -> Iterator[str]:
        """The compounds of common words of which one may be a slip in the last part.

        >>> word_lists("sv").intended_word("skokartog", "noun")
        ('skokartong', 'noun', '')
        """
        for n in range(_SHORTEST_PART, len(form) - _SHORTEST_SLIP + 1):
            first, last = form[:n], form[n:]
            if first not in self.things:
                continue
            if last in self.things:
                return
            for it in self.things:
                if len(it) >= _SHORTEST_SLIP and is_misspelling(last, it):
                    yield first + it

    def _run_together(self, form: str) -> tuple[str, str, str] | None:
        """The noun and article of which a form is made: "acap"."""
        for article in sorted(self.articles, key=len, reverse=True):
            noun = form.removeprefix(article)
            if noun != form and noun in self.things and len(noun) > len(article):
                return noun, "noun", article
        return None

    def _is_word(self, form: str) -> bool:
        """Whether a form is in one of the lists."""
        lists = (
            self.things,
            self.materials,
            self.qualities,
            self.abstract,
            self.doubtful,
            self.parts,
            self.aspects,
            self.evaluations,
            self.closed,
            self.fillers,
            self.names,
        )
        return any(form in it for it in lists)

    def _is_quality(self, word: str) -> bool:
        if self.quality_endings and word.endswith(self.quality_endings):
            return True
        return any(it in self.qualities for it in (word, *word.split("-")[-1:]))


_SHORTEST_PART, _SHORTEST_SLIP = 3, 5
"""How many letters the parts of a compound have at least; the last may be a slip."""


def _head(form: str, complements: Iterable[str]) -> str:
    """The word of a noun that says what it is: the last, or the one before "of"."""
    words = form.split("_")
    at = next((n for n, it in enumerate(words) if n and it in complements), None)
    return words[-1 if at is None else at - 1]


_ROWS = ("qwertyuiopå", "asdfghjklöä", "zxcvbnm")
_VOWELS = frozenset("aeiouyåäöéèüæøáíóúêôàçñ")


_MOST_VOWELS = 4
"""How many vowels may stand in a word without any other letter."""


def is_noise(form: str) -> bool:
    """Whether a word is none of any language: fingers on the keyboard, or no vowels.

    >>> words = ("cup", "asdfgh", "rhythm", "hgfk", "aaargh", "wug", "öäåöä")
    >>> [it for it in words if is_noise(it)]
    ['asdfgh', 'hgfk', 'aaargh', 'öäåöä']
    """
    for word in form.split("_"):
        rows = [*_ROWS, *(it[::-1] for it in _ROWS)]
        fours = (word[n : n + 4] for n in range(len(word) - 3))
        if any(four in row for four in fours for row in rows):
            return True
        if (
            len(word) > 3
            and word.isalpha()
            and word.isascii()
            and not _VOWELS & {*word}
        ):
            return True
        if len(parts := word.split("-")) > 2 and all(len(it) == 1 for it in parts):
            return True  # "c-u-p"
        if any(a == b == c for a, b, c in zip(word, word[1:], word[2:], strict=False)):
            return True
        if len(word) > _MOST_VOWELS and _VOWELS.issuperset(word):
            return True
    return False


def _replace_forms(text: str, forms: Mapping[str, str]) -> str:
    """The text with each of the forms in it replaced, in order."""
    if not _any_spoken(tuple(forms)).search(text):
        return text
    for said, written in forms.items():
        text = _expression_of(said).sub(written, text)
    return text


@lru_cache(4096)
def _expression_of(pattern: str) -> re.Pattern[str]:
    """The compiled expression of a form; `re` itself keeps 512 of them, too few."""
    return re.compile(_spoken(pattern))


def _spoken(pattern: str) -> str:
    """The expression of a form as it is spoken, as whole words in any letters."""
    return rf"(?i:(?<![\w'’])(?:{pattern})(?![\w'’]))"


@lru_cache
def _any_spoken(patterns: tuple[str, ...]) -> re.Pattern[str]:
    """One expression for any of the forms; without any, one that fits nothing."""
    return re.compile(_spoken("|".join(patterns)) if patterns else r"(?!)")


_LONGEST_PHRASE = 8


def _runs(phrases: Set[tuple[str, ...]], forms: Sequence[str]) -> Iterator[range]:
    """Where phrases stand among words, the longest from each word on."""
    for at in range(len(forms)):
        for end in range(min(len(forms), at + _LONGEST_PHRASE), at, -1):
            if tuple(forms[at:end]) in phrases:
                yield range(at, end)
                break


def plain_text(text: str) -> str:
    """A text in small letters without punctuation, as sayings are looked for in it.

    >>> plain_text("That's the spirit!")
    "that's the spirit"
    """
    return " ".join(_PLAIN.sub(" ", text.lower().replace("’", "'")).split())


def word_lists(language: str) -> WordLists:
    """The lists of a language."""
    return _word_lists(language, last_change(WORDS, language))


@lru_cache
def _word_lists(language: str, _: int) -> WordLists:
    try:
        data = read_table(WORDS, language)
    except FileNotFoundError:
        return WordLists()
    return WordLists(
        abstract=frozenset(data.get("abstract", "").split()),
        doubtful=frozenset(data.get("doubtful", "").split()),
        qualities=frozenset(data.get("qualities", "").split()),
        things=frozenset(data.get("things", "").split()),
        materials=frozenset(data.get("materials", "").split()),
        quality_endings=tuple(data.get("quality_endings", "").split()),
        evaluations=frozenset(data.get("evaluations", "").split()),
        endings=tuple(data.get("abstract_endings", "").split()),
        parts=frozenset(data.get("parts", "").split()),
        aspects=frozenset(data.get("aspects", "").split()),
        harmless=_phrases(data.get("harmless", "") + " " + data.get("fillers", "")),
        fillers=frozenset(data.get("fillers", "").split()),
        joining=frozenset(data.get("joining", "").split()),
        closed=frozenset(data.get("closed", "").split()),
        unreal=_phrases(data.get("unreal", "")),
        repairs=_phrases(data.get("repairs", "")),
        repair=next(iter(data.get("renewals", "").split()), "").replace("_", " "),
        renewals=_phrases(data.get("renewals", "")),
        names=frozenset(data.get("names", "").split()),
        contents=frozenset(data.get("contents", "").split()),
        articles=frozenset(data.get("articles", "").split()),
        negations=frozenset(data.get("negations", "").split()),
        auxiliaries=frozenset(data.get("auxiliaries", "").split()),
        reasons=frozenset(data.get("reasons", "").split()),
        addressees=frozenset(data.get("addressees", "").split()),
        copulas=frozenset(data.get("copulas", "").split()),
        numbers=tuple(data.get("numbers", "").split()),
        swapped=_transpositions(data.get("small_words", "").split()),
        spoken=data.get("spoken", {}),
        across=data.get("across", {}),
        elliptic=data.get("elliptic", {}),
        opposites=data.get("opposites", {}),
        reversing=data.get("reversing", ""),
        reversed=data.get("reversed", ""),
        sides=data.get("sides", {}),
        elsewhere=data.get("elsewhere", {}),
    )


def _transpositions(words: Sequence[str]) -> dict[str, str]:
    """Each of the words as it is with two letters beside one another changed about.

    >>> _transpositions(["the"])
    {'hte': 'the', 'teh': 'the'}
    """
    found = {
        word[:n] + word[n + 1] + word[n] + word[n + 2 :]: word
        for word in words
        for n in range(len(word) - 1)
    }
    return {form: word for form, word in found.items() if form not in words}


def _phrases(listed: str) -> frozenset[tuple[str, ...]]:
    """Phrases of a list, with underlines for their spaces."""
    return frozenset(tuple(it.split("_")) for it in listed.split())
