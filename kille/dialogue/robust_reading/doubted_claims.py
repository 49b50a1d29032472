"""Why what an island claims is not learned at once, but asked about or passed over."""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.robust_reading.admissible_covers import is_taken_up
from kille.dialogue.robust_reading.clause_words import Word, are_harmless
from kille.dialogue.robust_reading.island_covers import Cover
from kille.dialogue.robust_reading.island_kinds import ABOUT_KINDS, CLAIMS, INDIRECT
from kille.dialogue.robust_reading.island_weights import new_words
from kille.dialogue.robust_reading.islands import Island
from kille.dialogue.robust_reading.self_repairs import RepairedSentence
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.word_lists import PARTIAL, SAYING, WordLists

HEDGING = frozenset({"okay", "affirm", "deny", "ask_deed"})
"""The moves beside which a claim is asked about: "Maybe, this is a cup."."""


def doubt_about(
    island: Island,
    cover: Cover,
    sentence: RepairedSentence,
    situation: Situation,
    lists: WordLists,
) -> str:
    """Why what an island claims is not learned at once, or nothing.

    Where it may correct what was just learned, "I meant mug." needs no question.

    It is a `SAYING` beside what is not so, or with a "not" that would be left out, and
    `PARTIAL` where the tutor may be asked.
    """
    rule, words = island.rule, sentence.words
    if rule not in CLAIMS | ABOUT_KINDS:
        return ""
    if lists.is_unreal(_forms_left(cover, sentence, lists)):
        return SAYING
    after = words[island.after : island.after + 1]
    if rule == "reject" and any(it.form in lists.reasons for it in after):
        return SAYING  # "It isn't a bottle because it's green."
    near = {it.form for it in cover.missed_near(island, words)}
    if rule in INDIRECT:
        near |= {it.form for it in words[island.first : island.after]}
    if near & lists.negations:
        return SAYING
    if rule in ABOUT_KINDS or _names_what_was_asked(island, cover, situation, lists):
        return ""
    asks = sentence.is_question and (
        are_harmless(words[island.after :]) or _is_first_choice(island, cover)
    )
    hedged = any(
        it.rule in HEDGING and not is_taken_up(it, cover) for it in cover.islands
    )
    left_out = bool(cover.missed) or not sentence.is_certain
    indirect = rule in INDIRECT and not (
        situation.has_learned and _says_meant(island, words, lists)
    )
    return PARTIAL if indirect or hedged or asks or left_out else ""


def _says_meant(island: Island, words: Sequence[Word], lists: WordLists) -> bool:
    """Whether it says that a common noun, or one with an article, was meant instead."""
    inside = [it.form for it in words[island.first : island.after]]
    is_noun = inside[-1] in lists.things or not lists.articles.isdisjoint(inside)
    return island.rule == "meant" and is_noun


def _names_what_was_asked(
    island: Island, cover: Cover, situation: Situation, lists: WordLists
) -> bool:
    """Whether it is a noun that all know, said alone when it asked what a thing is."""
    if island.rule != "alone" or not situation.asks_name:
        return False
    if len(cover.islands) > 1 or cover.missed:
        return False
    words = {form for tree in island.trees for form in new_words(tree)}
    return words <= lists.things | situation.known


def _is_first_choice(island: Island, cover: Cover) -> bool:
    """Whether only other choices come after it: "Would it be a bowl or a plate?"."""
    after = cover.after(island)
    return bool(after) and all(it.rule == "ask_whether" for it in after)


def _forms_left(
    cover: Cover, sentence: RepairedSentence, lists: WordLists
) -> list[str]:
    """The words without a no that a correction says, without harmless phrases, and
    without those that say where something has another name."""
    forms = [it.form for it in sentence.words]
    taken_up = [
        it
        for it in cover.islands
        if is_taken_up(it, cover) or it.rule == "also_named"  # "if you are British"
    ]
    gone = {at for it in taken_up for at in range(it.first, it.after)}
    runs = lists.harmless_runs(forms)
    gone |= {at for run in runs if len(run) > 1 for at in run}  # "if you like"
    return [it for at, it in enumerate(forms) if at not in gone]
