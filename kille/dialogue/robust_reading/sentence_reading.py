"""Read a sentence by the best cover of its islands.

Each reading of an island is the type of a move, as if it had been said alone. What
would teach something, and leaves out words that are not harmless, is doubted: the robot
asks whether it is meant, and learns from a yes. Beside "if" and "looks like" nothing is
claimed, and no claim is made of a sentence whose "not" would be left out.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from kille.dialogue.language import Reader, Sentence, Utterance, reader
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import DialogueTypes, packaged_types, set_to, value_at
from kille.dialogue.parsing import parts
from kille.dialogue.robust_reading.admissible_covers import (
    follows_no,
    is_list_of_names,
    is_taken_up,
    keep_admissible,
)
from kille.dialogue.robust_reading.clause_words import Word
from kille.dialogue.robust_reading.doubted_claims import doubt_about
from kille.dialogue.robust_reading.island_covers import Cover, best_covers
from kille.dialogue.robust_reading.island_kinds import (
    ALONE,
    CORRECTED,
    ELLIPTIC,
    FALLBACK,
    FOLLOWS,
)
from kille.dialogue.robust_reading.island_weights import weigh_island
from kille.dialogue.robust_reading.islands import Island
from kille.dialogue.robust_reading.lessons_together import (
    doubt_lesson,
    fill_from,
    is_about_it,
)
from kille.dialogue.robust_reading.rivals import are_rivals, with_rivals
from kille.dialogue.robust_reading.self_repairs import RepairedSentence, repair_sentence
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.robust_reading.whole_sentences import is_weak
from kille.dialogue.word_lists import (
    PARTIAL,
    SAYING,
    WordLists,
    plain_text,
    word_lists,
)
from ttr import Rec, RecType

_UNSPEAKABLE = re.compile(r"[<>\[\]{}|\\^=@\x00-\x08\x0e-\x1f\x7f-\x9f\u202a-\u202e]")
"""Signs of markup, of programs and of terminals: what has any is not talk."""

VAGUE = FALLBACK | {"alone", "named", "ask_deed"}
"""What may be read of almost any words, so that they are not understood thereby."""


class Understanding(NamedTuple):
    """What was understood of a sentence: moves in order, and the words it misses."""

    moves: tuple[Sentence, ...]
    parts: tuple[str, ...]
    missed: tuple[str, ...]
    is_remark: bool = False
    """Whether it only is taken as a remark."""
    dropped: tuple[str, ...] = ()
    """The clauses that say something of something, and of which no move is made."""


NOTHING = Understanding((), (), ())


def read_robustly(
    text: str,
    situation: Situation,
    language: str = "en",
    *,
    types: DialogueTypes | None = None,
) -> Understanding:
    """What is understood of a sentence that the grammar does not read as a whole.

    >>> said = read_robustly("Umm, well, I've found a whisk!", Situation(things=1))
    >>> [move] = said.moves
    >>> move.readings[0].type["doubt"].value, said.missed
    ('partial', ("I've", 'found'))
    """
    lists, types = word_lists(language), types or packaged_types()
    reads = reader(language, types)
    sentence = repair_sentence(text, lists)
    if sentence.is_certain and sentence.plain != text:
        whole = reads.sentences(sentence.plain)
        if all(it.readings and not is_weak(it, situation, lists) for it in whole):
            return Understanding(whole, (sentence.plain,), ())
    grammar = reads.island_grammar
    if grammar is None or _UNSPEAKABLE.search(sentence.plain):
        return NOTHING
    weigh = partial(weigh_island, situation, sentence.is_question, lists)
    found = best_covers(sentence.plain, sentence.words, grammar, weigh, lists, FOLLOWS)
    covers = [keep_admissible(it, sentence, situation) for it in found]
    ranked = sorted(
        (it for it in covers if it.islands),
        key=lambda it: (
            _is_fallback(it),
            -_rank(it, sentence),
            it.islands[0].first,
        ),
    )
    reading = _CoverReading(sentence, situation, lists, reads, types)
    for n, best in enumerate(ranked):
        moves = reading.read_cover(best)
        if moves:
            moves = reading.with_rivals(moves, best, ranked[n + 1 :])
            return Understanding(
                moves,
                tuple(sentence.text_of(it.first, it.after) for it in best.islands),
                tuple(sentence.plain[it.begin : it.end] for it in best.missed),
                _is_fallback(best),
                _clauses_left_out(best, sentence, lists),
            )
    if lexicon(language).is_saying(plain_text(sentence.plain)):
        return _as_remark(text, types)
    return _phrases(sentence, found)


def _as_remark(text: str, types: DialogueTypes) -> Understanding:
    """A saying that can be read as nothing else: it is heard as a remark."""
    remark = set_to(
        types.move_type("Heard", "Remark"),
        text=types["Text"] @ text,
        signs=types.record_type("Heard")["signs"] @ (),
        content=RecType @ Rec,
    )
    heard = Sentence(text, (Utterance(text, remark),))
    return Understanding((heard,), (text,), (), is_remark=True)


class _CoverReading(NamedTuple):
    """How the covers of a sentence are read."""

    sentence: RepairedSentence
    situation: Situation
    lists: WordLists
    reads: Reader
    types: DialogueTypes

    def read_cover(self, cover: Cover) -> tuple[Sentence, ...]:
        """The moves that the islands of a cover can be read as, in order."""
        heard: list[Sentence] = []
        for island in cover.islands:
            if is_taken_up(island, cover):
                continue
            move = self.read_island(island, cover)
            if island.rule in ELLIPTIC:
                move = fill_from(move, heard, types=self.types)
            if island.rule == "is_not" and self._takes_back(move, heard):
                heard.pop()  # "One might think it's a bowl, but it isn't."
                move = doubt_lesson(move, PARTIAL, types=self.types, anew=True)
            heard.append(move)
        moves = {it.readings[0].type: it for it in reversed(heard) if it.readings}
        return tuple(reversed(moves.values()))

    def read_island(self, island: Island, cover: Cover) -> Sentence:
        """How an island can be read as a move, doubted where it must be."""
        doubt = doubt_about(island, cover, self.sentence, self.situation, self.lists)
        moves = dict.fromkeys(part for tree in island.trees for part in parts(tree))
        if follows_no(island, cover):
            moves = {
                it._replace(rule=CORRECTED.get(it.rule, it.rule)): None for it in moves
            }
        text = self.sentence.said
        readings = self.reads.readings(text, moves, doubt)
        part = self.sentence.text_of(island.first, island.after)
        adds = island.rule == "also_named"
        return Sentence(text, readings, adds=adds, part=part)

    def _takes_back(self, denial: Sentence, heard: Sequence[Sentence]) -> bool:
        """Whether a denial is of what was said before as what is not so, or of "it"."""
        if not heard:
            return False
        return is_saying(heard[-1]) or is_about_it(denial, types=self.types)

    def with_rivals(
        self, moves: tuple[Sentence, ...], best: Cover, others: Sequence[Cover]
    ) -> tuple[Sentence, ...]:
        """The moves of a cover; a single one with what it may be instead."""
        if len(moves) > 1 or len(best.islands) > 1 or best.islands[0].rule in ELLIPTIC:
            return moves
        rivals = [
            (it.weight, self.read_island(it.islands[0], it))
            for it in others
            if are_rivals(it, best)
        ]
        return (with_rivals(moves[0], best.weight, rivals),)


def is_saying(it: Sentence) -> bool:
    """Whether the best reading of a sentence is doubted as no claim at all."""
    best = it.readings[0].type if it.readings else None
    return best is not None and "doubt" in best and value_at(best, "doubt") == SAYING


def _rank(cover: Cover, sentence: RepairedSentence) -> float:
    """The weight of a cover; several names in a row are one thing to say."""
    if is_list_of_names(cover, sentence):
        return cover.weight / ALONE ** (len(cover.islands) - 1)
    if [it.rule for it in cover.islands[:2]] == ["alone", "also_named"]:
        return cover.weight / ALONE  # "Eraser, or rubber if you're British."
    return cover.weight


def _is_fallback(cover: Cover) -> bool:
    """Whether a cover is all remarks and the like."""
    return all(it.rule in FALLBACK for it in cover.islands)


def _clauses_left_out(
    cover: Cover, sentence: RepairedSentence, lists: WordLists
) -> tuple[str, ...]:
    """The clauses of a sentence that a cover leaves out, and that claim something.

    Such a clause has a copula, and says a word that the cover does not: "the long one
    isn't", but not "I found it in the attic". What is said of the robot, or of what was
    said, is no claim about things: "you are clever", "both are correct".
    """
    words = sentence.words
    taken = {words[at].form for it in cover.islands for at in range(it.first, it.after)}
    clauses = dict.fromkeys(it.clause for it in cover.missed)
    found = []
    for clause in clauses:
        inside = [it for it in words if it.clause == clause]
        said = [it for it in inside if not it.is_harmless]
        if not set(said) <= set(cover.missed):
            continue
        subject = [it.form for it in inside if not it.joins][:2]
        if not lists.addressees.isdisjoint(subject):
            continue
        if _claimed_words(said, lists) - taken:
            first, last = words.index(said[0]), words.index(said[-1])
            found.append(sentence.text_of(first, last + 1))
    return tuple(found)


def _claimed_words(words: Sequence[Word], lists: WordLists) -> set[str]:
    """What a clause says of something; nothing without a copula, or of itself."""
    forms = [it.form for it in words]
    copulas = [it for it in forms if lists.has_copula(it)]
    said = {it for it in forms if it not in copulas and not lists.is_closed(it)}
    said -= lists.articles | lists.evaluations
    if not copulas or {it.partition("'")[0] for it in copulas} >= said:
        return set()  # "A cup's a cup."
    return said


def _phrases(sentence: RepairedSentence, found: Sequence[Cover]) -> Understanding:
    """No move, but perhaps phrases that are understood, in the speaker's own words."""
    stretches = (
        sentence.text_of(it.first, it.after)
        for cover in found[:1]
        for it in cover.islands
        if it.after - it.first > 1 and it.rule not in VAGUE
    )
    phrases = [it for it in stretches if it in sentence.said]
    missed = tuple(
        sentence.plain[it.begin : it.end] for it in sentence.words if not it.is_harmless
    )
    return Understanding((), tuple(phrases), missed)
