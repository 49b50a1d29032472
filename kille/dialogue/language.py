"""From what is said to types: parsing is judging what kind of event it is.

The grammar says which words belong together, the theory what that means; rules and
types are matched by their names. A rule with a type of its name means that type merged
with what its parts mean. A rule without one is the label of its part's meaning. A rule
whose type has a place for a word finds a word; a rule with a basic type, such as a
number, finds a text.

What can be read in several ways has several readings. They are alternatives of one
event, and the state of the dialogue decides between them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache
from itertools import dropwhile, islice, product, zip_longest

from kille.dialogue.grammar_cache import recall_grammar
from kille.dialogue.grammars import GrammarError
from kille.dialogue.language_files import FILES, ISLANDS, last_change, source
from kille.dialogue.lexicon import Lexicon, lexicon
from kille.dialogue.lookalikes import replace_lookalikes
from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    claims,
    merge_of,
    packaged_types,
    set_to,
    value_at,
)
from kille.dialogue.parsing import Grammar, Token, Tree, parts, words
from kille.dialogue.restarts import join_repairs, settle_spelling
from kille.dialogue.robot_grammar import CLOSELY, LOOSELY, robot_rules
from kille.dialogue.word_lists import (
    CUT_OFF,
    DOUBTFUL,
    NAME,
    PARTIAL,
    REMARK,
    SAYING,
    is_noise,
    plain_text,
    word_lists,
)
from ttr import Rec, Record, RecordType, RecType, rectype
from ttr.types import TypeNode

__all__ = [
    "LANGUAGES",
    "Sentence",
    "Utterance",
    "grammar_text",
    "overhear",
    "understand",
]

LANGUAGES = ("en", "sv")
"""The languages that there is a grammar and a lexicon of.

>>> from kille.dialogue.language import LANGUAGES
>>> LANGUAGES
('en', 'sv')
"""

_LONGEST = 400
"""Characters; no sentence of the grammar has more."""

_REMEMBERED = 1024
"""Sentences of which the readings are kept; parsing takes most of a turn's time."""

_READINGS = 16
"""How many readings a sentence has at most: the simplest ones."""

LESSONS = (
    "instruct",
    "instruct_several",
    "instruct_every",
    "instruct_only",
    "describe",
    "correct",
    "reject",
    "weigh_cue",
    "generalise",
)
"""The moves that say what a thing is, or how: for them words are vetted."""

TELL_PART = "tell_part"
"""The move that says of a thing which part it has: no lesson, but perhaps a remark."""

RELATE = "relate"
"""The move that says where a thing is; of its words only a saying makes no lesson."""

QUALIFIED = "qualified"
"""What a noun of several words is that may be an adjective and a noun."""

UNLIKELY = "unlikely"
"""The stance of who supposes that something is not so: "It isn't a cup, is it?"."""

OUTRIGHT = "outright"
"""The stance of who says in so many words that one kind is a kind of another."""

TAUGHT = "taught"
"""The stance of who asks which words were taught, and not which are known."""

STANCES = {
    "asserted": "asserted_stance",
    "supposed": "supposed_stance",
    UNLIKELY: "unlikely_stance",
    "reversed": "reversed_stance",
    "of all": "of_all_stance",
    "conceding": "conceding_stance",
    "other than": "other_than_stance",
    OUTRIGHT: "outright_stance",
    TAUGHT: "taught_stance",
}
"""How somebody says a thing that can be said in several ways, and the rules for it.

As a claim or as a question; a no, that it is the other way round; a yes or no, that it
is so of all things; a yes, that the robot was right after all; a phrase, that it says
what is not meant; and of two kinds, that the one is a kind of the other, with nouns
that are none of doubtful things.
"""

_FORMS = 3
"""How many words a form is read as, at most; those in the lexicon come first."""

_Changes = tuple[int, ...]
"""When the files of a language were changed last."""

_ABBREVIATION = re.compile(r"\b[^\W\d_]{1,2}\.(?:[^\W\d_]{1,2}\.)+")
"""Letters with a dot after each, which end no sentence: "i.e."."""

_SENTENCE = re.compile(r"[^.!?…\n]+[.!?…\n]*")


@dataclass(frozen=True)
class Utterance:
    """What was said: the text, and the type of the event of saying it.

    >>> [said] = understand("This is a red cup.")
    >>> [it.form for it in said.readings[0].signs]
    ['red cup']
    """

    text: str
    type: RecordType

    @property
    def content(self) -> RecordType:
        """What the utterance is about."""
        content = value_at(self.type, "content")
        if not isinstance(content, RecordType):
            raise TypeError(f"what is said is a record type, but found {content}")
        return content

    @property
    def signs(self) -> tuple[Record, ...]:
        """The words in it, in order."""
        signs: tuple[Record, ...] = value_at(self.type, "signs")
        return signs


@dataclass(frozen=True)
class Sentence:
    """A move of the tutor's: the text, and how it can be read, the simplest way first.

    Without any reading it was not understood. How probable each is says `weights`;
    without any they are equally so.

    >>> [said] = understand("This is a cup.")
    >>> said.text, len(said.readings)
    ('This is a cup.', 1)
    """

    text: str
    readings: tuple[Utterance, ...]
    weights: tuple[float, ...] = field(default=(), repr=False)
    adds: bool = field(default=False, repr=False)
    """Whether it adds a word to one that was just said: "also called a mug"."""
    part: str = field(default="", repr=False, compare=False)
    """The stretch of the text that says it, where it is not all of it."""


def understand(
    text: str, language: str = "en", *, types: DialogueTypes | None = None
) -> tuple[Sentence, ...]:
    """What a tutor's text says, move by move.

    >>> [said] = understand("This is a cup.")
    >>> print(said.readings[0].content)  # doctest: +NORMALIZE_WHITESPACE
    [look : Look, target : [look = ^.look : Look, x : Ind, d : shown(x, look)],
     c : cup(target.x, look)]
    >>> understand("Colourless green ideas.")
    (Sentence(text='Colourless green ideas.', readings=()),)
    """
    reads = reader(language, types or packaged_types())
    found: list[Sentence] = []
    lists = word_lists(language)
    plain = settle_spelling(lists.join_sentences(replace_lookalikes(text)))
    plain = join_repairs(plain, lists)
    plain = _ABBREVIATION.sub(lambda it: it[0].replace(".", ""), plain)
    for part in _SENTENCE.findall(plain):
        if re.search(r"\w", part):
            found += reads.sentences(part.strip())
    return tuple(found) or (Sentence(text, ()),)


def overhear(
    text: str, language: str = "en", *, types: DialogueTypes | None = None
) -> tuple[Utterance, ...]:
    """What a text of the robot's says: how it can be read, the simplest way first.

    The wordings of the lexicon are its grammar. The text does not say which things are
    meant. What it does not say of a rival is as in the content.

    >>> [learned] = overhear("OK, I learned a cup.")
    >>> print(learned.content)  # doctest: +NORMALIZE_WHITESPACE
    [look : Look, target : [look = ^.look : Look, x : Ind], c : cup(target.x, look)]
    """
    reads = reader(language, types or packaged_types())
    grammar = _robots_grammar(language, _changes(language))
    trees = grammar.parse(text.strip(), CLOSELY) or grammar.parse(text.strip(), LOOSELY)
    found = (
        T for tree in trees for move in parts(tree) for T in reads.said_types(move)
    )
    return tuple(Utterance(text, T) for T in dict.fromkeys(found))


@lru_cache
def _grammar(language: str, _: _Changes) -> Grammar:
    return Grammar(grammar_text(language), read=recall_grammar)


@lru_cache
def _island_grammar(language: str, _: _Changes) -> Grammar | None:
    """The grammar of islands; None where it does not fit a grammar of one's own."""
    try:
        islands = grammar_text(language) + source(ISLANDS, language)
        return Grammar(islands, "island", read=recall_grammar)
    except GrammarError:
        return None


@lru_cache
def _robots_grammar(language: str, _: _Changes) -> Grammar:
    tutors = grammar_text(language)
    robots = tutors + robot_rules(lexicon(language), tutors)
    return Grammar(robots, CLOSELY, LOOSELY, read=recall_grammar)


def grammar_text(language: str) -> str:
    """The grammar of a language, in Lark's notation.

    >>> "start" in grammar_text("en")
    True
    """
    return source("tutor.{}.lark", language)


def reader(language: str, types: DialogueTypes) -> Reader:
    """What reads the sentences of a language as moves of a theory."""
    return types.derive(_reader, language, _changes(language))


def _reader(types: DialogueTypes, language: str, changes: _Changes) -> Reader:
    return Reader(types, lexicon(language), _grammar(language, changes))


def _changes(language: str) -> _Changes:
    return tuple(last_change(file, language) for file in FILES)


Meant = tuple[tuple[Record, ...], RecordType]
"""The words of a part, in the order in which they were said, and what it means."""


class Reader:
    """From trees to types, with the words of one language."""

    def __init__(
        self, types: DialogueTypes, lexicon_: Lexicon, grammar: Grammar
    ) -> None:
        self._types, self._lexicon, self._grammar = types, lexicon_, grammar
        self._lists = word_lists(lexicon_.language)
        self._changes = _changes(lexicon_.language)
        self._meanings = lru_cache(4 * _REMEMBERED)(self._meanings_anew)
        self.sentences = lru_cache(_REMEMBERED)(self._sentences_anew)

    def _sentences_anew(self, text: str) -> tuple[Sentence, ...]:
        """The moves of one sentence, each with its readings."""
        plain = " ".join(text.split())
        trees = self._grammar.parse(plain) if len(plain) <= _LONGEST else []
        if not trees:
            return (Sentence(text, ()),)
        trees = sorted(trees, key=lambda tree: len(parts(tree)))
        fewest = len(parts(trees[0]))
        alike = [parts(tree) for tree in trees if len(parts(tree)) == fewest]
        return tuple(
            Sentence(text, self.readings(text, dict.fromkeys(moves)))
            for moves in zip(*alike, strict=True)
        )

    @property
    def island_grammar(self) -> Grammar | None:
        """The grammar of what may be understood in the middle of a sentence, if any."""
        return _island_grammar(self._lexicon.language, self._changes)

    def readings(
        self, text: str, moves: Iterable[Tree], doubt: str = ""
    ) -> tuple[Utterance, ...]:
        """The different readings of a move; a lesson is doubted for this reason."""
        agreeing_first = sorted(moves, key=lambda it: not self._agrees(it, text))
        each = [self._heard_types(text, it, doubt) for it in agreeing_first]
        types = (T for them in zip_longest(*each) for T in them if T is not None)
        return tuple(
            Utterance(text, T) for T in islice(dict.fromkeys(types), _READINGS)
        )

    def _agrees(self, move: Tree, text: str) -> bool:
        """Whether an adjective that may be neuter is said of what may be neuter.

        "Flaskan är spräckt" has no neuter form: *flaskan* is none, nor is *den*.
        """
        found = list(_tokens(move))
        if not any(it.terminal == "NEUTER" for it in found):
            return True
        about = [it.text.lower() for it in found if it.terminal == "DEFINITE"]
        common = self._lexicon.common_gender
        if not common:
            return True
        return re.search(common, " ".join(about[:1]) or text.lower()) is None

    def _heard_types(
        self, text: str, move: Tree, partly: str = ""
    ) -> Iterator[RecordType]:
        """The types of the event: who speaks to whom, its move, words and content."""
        is_lesson = move.rule in LESSONS
        may_be_saying = is_lesson or move.rule == RELATE
        is_saying = may_be_saying and self._is_saying(text)
        for signs, content in self._together(move):
            if any(is_over_break(it.form, text) for it in signs if it.kind == "noun"):
                continue
            heard = set_to(
                self._types.move_type("Heard", _type_name(move.rule)),
                text=self._types["Text"] @ text,
                signs=self._types.record_type("Heard")["signs"] @ signs,
                content=RecType @ content,
            )
            doubt = self._doubt(signs, content, text) if is_lesson else ""
            intended = self._intended_signs(signs, content, partly) if is_lesson else ()
            if intended and (doubt in ("", DOUBTFUL) or any(map(_is_noisy, signs))):
                doubt = ""
                heard = set_to(
                    heard,
                    intended=self._types.record_type("Intended")["intended"] @ intended,
                )
            if move.rule == TELL_PART:
                judged = self._doubt(signs, content, text)
                doubt = judged if judged != PARTIAL else ""
            if any(it.rule == "material" for it in parts(move)) or (
                partly and doubt == DOUBTFUL and self._says_material(signs, content)
            ):
                doubt = PARTIAL if doubt == DOUBTFUL else doubt
                doubt, partly = ("", partly) if partly == SAYING else (doubt, doubt)
            for stance, rule in STANCES.items():
                if stance == OUTRIGHT and any(map(self._is_doubtful_noun, signs)):
                    continue
                if any(it.rule == rule for it in parts(move)):
                    heard = set_to(heard, stance=self._types["Text"] @ stance)
            doubt = SAYING if is_saying else doubt
            if partly == SAYING and doubt == PARTIAL:
                doubt = SAYING  # "I'd like a cup of coffee."
            if move.rule == "reject" and self._denies_article(signs):
                doubt = SAYING
            doubt = REMARK if doubt == DOUBTFUL and partly else doubt or partly
            if doubt == QUALIFIED:
                doubt = partly or DOUBTFUL
            yield set_to(heard, doubt=self._types["Text"] @ doubt) if doubt else heard

    def _says_material(self, signs: Iterable[Record], content: RecordType) -> bool:
        """Whether a claim is of what a thing is made."""
        said = (it for it in signs if it.kind == "adjective" and claims(content, it))
        return any(it.form in self._lists.materials for it in said)

    def _is_saying(self, text: str) -> bool:
        """Whether a text is a saying, whatever fillers it begins with: "Ugh, …"."""
        plain = plain_text(text)
        words = dropwhile(self._lists.fillers.__contains__, plain.split())
        return any(map(self._lexicon.is_saying, {plain, " ".join(words)}))

    def _doubt(self, signs: Iterable[Record], content: RecordType, text: str) -> str:
        """Why the word of a lesson may be none that is said of things, or nothing."""
        if "component" in content:
            said = (it for it in signs if it.meaning == content["component"])
        elif "counted" in content:
            words = tuple(signs)
            if not words:
                return SAYING  # "These are things."
            nouns = tuple(it for it in words if it.kind == "noun")
            said = (it for it in nouns or words)  # "These are cups."  "These are red."
        else:
            said = (it for it in signs if claims(content, it))
        for sign in said:
            if is_cut_off(sign.form, text):
                return CUT_OFF
            if not sign.article and is_proper_name(sign.form, text):
                return NAME
            if "component" in content:
                return self._lists.judge_part(sign.form, self._lexicon.complements)
            if sign.kind == "noun":
                judged = self._lists.judge_noun(sign.form, self._lexicon.complements)
                if not judged and is_written_apart(sign.form, text):
                    return PARTIAL
                return judged or (QUALIFIED if self._is_qualified(sign.form) else "")
            if "counted" in content and sign.form in self._lists.materials:
                return ""  # "They are both made of glass."
            if sign.kind == "adjective":
                judged = self._lists.judge_quality(sign.form)
                is_how = judged == DOUBTFUL and self._says_how(sign.form)
                return PARTIAL if is_how else judged
        return ""

    def _intended_signs(
        self, signs: Iterable[Record], content: RecordType, partly: str
    ) -> tuple[Record, ...]:
        """The common word that the one of a lesson may be a slip of, if any.

        In a part of a sentence it may be a noun without an article: "this is teddy".
        """
        sign = next((it for it in signs if claims(content, it)), None)
        if sign is None or sign.kind not in ("noun", "adjective"):
            return ()
        found = self._lists.intended_word(sign.form, sign.kind)
        if partly and sign.kind == "adjective" and sign.form in self._lists.things:
            found = (sign.form, "noun", "")
        if found is None:
            return ()
        form, kind, article = found
        main = self._lexicon.main_form(form)
        means = "" if kind == "noun" else self._lexicon.means.get(main, "")
        own = article or (sign.article if kind == "noun" else "")
        return (self._types.sign(main, kind, own, means),)

    def _is_doubtful_noun(self, sign: Record) -> bool:
        """Whether a noun may be for nothing that is seen, or a slip of another."""
        if self._lists.judge_noun(sign.form, self._lexicon.complements):
            return True
        slip = self._lists.intended_word(sign.form, sign.kind)
        return slip is not None or self._is_qualified(sign.form)

    def _is_qualified(self, form: str) -> bool:
        """Whether a noun begins with a word for how things are: "lovely cup"."""
        first, *others = form.split()
        return bool(others) and self._says_how(first)

    def _denies_article(self, signs: Iterable[Record]) -> bool:
        """Whether a noun has an article that is not its own: *inte en bord*."""
        nouns = (it for it in signs if it.kind == "noun" and it.article)
        return any(it.article != self._lexicon.article(it) for it in nouns)

    def _says_how(self, form: str) -> bool:
        """Whether a word is an adjective, by the lists or by how it ends."""
        inflected = (
            word
            for name in ("WEAK", "NEUTER")
            for inflection in self._lexicon.inflections.get(name, ())
            for word in inflection.words(form)
        )
        if not self._lists.qualities.isdisjoint((form, *inflected)):
            return True
        return form in self._lexicon.means or bool(
            self._lexicon.adjectives and re.search(self._lexicon.adjectives, form)
        )

    def _is_definite_noun(self, found: list[Token]) -> bool:
        """Whether a form is that of a noun, known or not: *örat* is no adjective."""
        form = " ".join(it.text.lower() for it in found)
        if any(
            word in self._lexicon.vocabulary
            for inflection in self._lexicon.inflections.get("DEFINITE", ())
            for word in inflection.words(form)
        ):
            return True
        forms = [it for it, _ in self._forms(found)]
        if not self._lists.qualities.isdisjoint((form, *forms)):
            return False
        return re.search(self._lexicon.definite_nouns or r"(?!)", form) is not None

    def _is_only_noun(self, found: list[Token]) -> bool:
        """Whether a form with an adjective's ending is a noun: *skaft*, not *skaf*."""
        form, lists = " ".join(it.text.lower() for it in found), self._lists
        if form in lists.materials or self._says_how(form):
            return False
        inflected = any(it.terminal in ("NEUTER", "WEAK") for it in found)
        return form in lists.parts or (inflected and form in lists.things)

    def _is_adjective(self, found: list[Token]) -> bool:
        """Whether what ends like a definite noun is an adjective: *vit*, *grön*."""
        if not any("DEFINITE" in it.terminal for it in found):
            return False
        form = " ".join(it.text.lower() for it in found)
        return form in self._lists.qualities or form in self._lexicon.means

    def said_types(self, move: Tree) -> Iterator[RecordType]:
        """The types of the event of the robot's saying this."""
        phrase = self._types.record_type("Phrase")
        for signs, all_of_it in self._together(move):
            content, rival = _apart(all_of_it, phrase)
            yield set_to(
                self._types.move_type("Said", _type_name(move.rule)),
                signs=self._types.record_type("Said")["signs"] @ signs,
                content=RecType @ content,
                rival=RecType @ rival,
            )

    def _together(self, tree: Tree) -> list[Meant]:
        """What the parts of a tree mean together, in every way, the likeliest first."""
        ways = []
        for meant in _by_rank([self._meanings(part) for part in parts(tree)]):
            together: RecordType = Rec
            for _, meaning in meant:
                together = merge_of(together, meaning)
            ways.append((tuple(it for signs, _ in meant for it in signs), together))
        return ways

    def _meanings_anew(self, tree: Tree) -> list[Meant]:
        """What a part of an utterance means, from what its own parts mean."""
        name = _type_name(tree.rule)
        if name in self._types and not isinstance(self._types[name], RecordType):
            text = " ".join(word.text for word in words(tree))
            return [((), rectype({tree.rule: self._types["Text"] @ text}))]
        if self._types.kind_in(name) is not None:
            return [
                ((it,), self._types.meaning_at(it, name))
                for it in self._signs(tree, name)
            ]
        together = self._together(tree)
        if name in self._types:
            return [
                (signs, merge_of(self._types.record_type(name), T))
                for signs, T in together
            ]
        return [(signs, rectype({tree.rule: T})) for signs, T in together]

    def _signs(self, tree: Tree, name: str) -> Iterator[Record]:
        """The words that a rule may have found, as signs."""
        kind = self._types.kind_in(name)
        assert kind is not None
        found = words(tree)
        said = "".join(it.text.lower() for it in found if it.terminal == "A")
        rest = [it for it in found if it.terminal != "A"]
        if kind == "adjective" and (
            self._is_definite_noun(rest) or self._is_only_noun(rest)
        ):
            return
        if kind == "noun" and self._is_adjective(rest):
            return
        for form, article in self._forms(rest):
            form = self._as_compound(form) if kind == "noun" else form
            main = self._lexicon.main_form(form)
            means = "" if kind == "noun" else self._lexicon.means.get(main, "")
            yield self._types.sign(main, kind, said or article, means)

    def _forms(self, found: list[Token]) -> Iterator[tuple[str, str]]:
        """The word that was found, with the article that its form shows."""
        text = " ".join(it.text.lower() for it in found)
        inflections = self._lexicon.inflections
        name = next((it.terminal for it in found if it.terminal in inflections), None)
        if name is None:
            yield text, ""
            return
        found_forms = [
            (form, inflection.article)
            for inflection in inflections[name]
            for form in inflection.words(text)
            if self._may_have(form, inflection.article)
        ]
        known = self._lexicon.vocabulary
        is_new = known.isdisjoint(it for it, _ in found_forms)
        if is_new and "DEFINITE" in name and self._is_known_otherwise(text):
            return
        yield from sorted(found_forms, key=lambda it: it[0] not in known)[:_FORMS]

    def _is_known_otherwise(self, text: str) -> bool:
        """Whether a form is a noun of the lexicon, or its plural: *äpplen*."""
        return text in self._lexicon.vocabulary or any(
            word in self._lexicon.vocabulary and self._may_have(word, it.article)
            for it in self._lexicon.inflections.get("PLURAL", ())
            for word in it.words(text)
        )

    def _may_have(self, form: str, article: str) -> bool:
        """Whether a noun may have the article that a form shows: *boket* is none."""
        articles = self._lexicon.articles
        return not article or not articles.has(form) or articles.of(form) == article

    def _as_compound(self, text: str) -> str:
        """Two nouns that are written apart as the one that they are: *färg burk*."""
        first, *others = text.split()
        if not self._lexicon.joins_compounds or len(others) != 1:
            return text
        if self._says_how(first) or any(map(self._lists.is_closed, (first, *others))):
            return text
        return first + others[0]


def _tokens(tree: Tree) -> Iterator[Token]:
    """The words of a tree, also those of its parts, in order."""
    for child in tree.children:
        if isinstance(child, Tree):
            yield from _tokens(child)
        else:
            yield child


def _is_noisy(sign: Record) -> bool:
    """Whether a word is none of any language, as it was typed."""
    return is_noise(sign.form)


def is_written_apart(form: str, text: str) -> bool:
    """Whether a text has the parts of a word as two words.

    >>> is_written_apart("färgburk", "En färg burk."), is_written_apart("bil", "En bil")
    (True, False)
    """
    plain = plain_text(text)
    return any(
        re.search(rf"\b{re.escape(form[:at])} {re.escape(form[at:])}\b", plain)
        for at in range(1, len(form))
    )


def is_over_break(form: str, text: str) -> bool:
    """Whether the parts of one word are apart by a comma: *en kopp, dumbom*.

    >>> is_over_break("koppdumbom", "En kopp, dumbom."), is_over_break("bil", "Bil, i")
    (True, False)
    """
    if " " in form or "," not in text:
        return False
    plain = " ".join(text.lower().split())
    return any(
        re.search(rf"\b{re.escape(form[:at])}, {re.escape(form[at:])}\b", plain)
        for at in range(1, len(form))
    )


_CUT_OFF = re.compile(r"\b(\w{1,2})(?:\.\.+|…|-+)\s*$")
"""The beginning of a word at the end of a text that breaks off there."""


def is_cut_off(form: str, text: str) -> bool:
    """Whether a text breaks off within its last word, which is this one.

    >>> is_cut_off("k", "This is a k..."), is_cut_off("cup", "This is a cup...")
    (True, False)
    """
    found = _CUT_OFF.search(text)
    return found is not None and found[1].lower() == form


def is_proper_name(form: str, text: str) -> bool:
    """Whether a word has a capital letter that no beginning of a sentence gives it.

    >>> is_proper_name("sixten", "This is Sixten."), is_proper_name("cup", "Cup.")
    (True, False)
    """
    named = rf"\w,? {re.escape(form.title())}\b"
    return text != text.upper() and re.search(named, text) is not None


def _by_rank(several: Sequence[Sequence[Meant]]) -> Iterator[tuple[Meant, ...]]:
    """Every choice of one from each; early ones first, by the sum of their places."""
    ranked = product(*(enumerate(them) for them in several))
    for chosen in sorted(ranked, key=lambda it: sum(rank for rank, _ in it)):
        yield tuple(meant for _, meant in chosen)


def _apart(all_of_it: RecordType, phrase: RecordType) -> tuple[RecordType, RecordType]:
    """The content, and its rival, which shares what is not said of it."""
    rival = all_of_it.get("rival")
    content = rectype({k: T for k, T in all_of_it.fields if k != "rival"})
    if not isinstance(rival, RecordType):
        return content, Rec
    same = rectype(
        {
            k: T
            for k, T in content.fields
            if k not in CLAIMS and not _is_described(rival.get(k), phrase)
        }
    )
    return content, merge_of(same, rival)


def _is_described(part: TypeNode | None, phrase: RecordType) -> bool:
    """Whether it is the phrase for a thing, and says something of it."""
    return isinstance(part, RecordType) and part.labels > phrase.labels


@cache
def _type_name(rule: str) -> str:
    """The name that a rule's type has in the theory: ask_name, AskName."""
    return "".join(part.capitalize() for part in rule.split("_"))
