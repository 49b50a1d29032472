"""How well a reading of an island fits what the talk is about.

Source: Lison 2013, for weighing readings by the state of the dialogue.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import takewhile

from kille.dialogue.parsing import Tree, parts, words
from kille.dialogue.robust_reading.island_kinds import CLAIMS
from kille.dialogue.robust_reading.islands import START
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.word_lists import WordLists

NEW = 0.8
"""The factor for every word of an island that the robot does not know."""

ASKED = 0.3
"""The factor for a claim in a sentence that ends with a question mark."""


def weigh_island(
    situation: Situation, is_question: bool, lists: WordLists, tree: Tree
) -> float:
    """The weight of a reading: 1 for what fits well, 0 for what is none here."""
    move = parts(tree)[0]
    rule = move.rule if tree.rule == START else tree.rule
    weight = NEW ** sum(it not in situation.known for it in new_words(move))
    if is_question and rule in CLAIMS:
        weight *= ASKED
    return weight * _fit(situation, rule, move, lists)


def _fit(situation: Situation, rule: str, move: Tree, lists: WordLists) -> float:
    """How well a move fits what the talk is about."""
    match rule:
        case "affirm" | "deny":
            return 1.0 if situation.asks_whether else 0.95
        case "mention":
            return 1.0 if situation.asks_which else 0.02
        case "take_frame" | "remark":
            return 0.02
        case "alone" if all(map(lists.names_quality, new_words(move))):
            return 0.0  # "Half-full."
        case "alone":
            return 0.5 if situation.asks_name else 0.25
        case "quality_alone":
            known = all(it in situation.qualities for it in new_words(move))
            if known or situation.asked == "AskQuality":
                return 0.5
            return 0.25 if all(map(lists.names_quality, new_words(move))) else 0.0
        case "presumed":
            new = any(it not in situation.known for it in new_words(move))
            return 0.05 if new else 0.0
        case "about" if _has_part(move, "it"):
            return 0.0
        case "about":
            return 0.02 if situation.asks_which else 0.9
        case "about_where":
            known = all(it in situation.known for it in new_words(move))
            return 0.9 if known or len(parts(move)) > 1 else 0.0
        case "side_told":
            known = all(_is_known(it, situation) for it in new_words(move))
            return 2.0 if known else 0.0
        case "side_named":
            known = all(_is_known(it, situation) for it in new_words(move))
            return 0.0 if known else 0.9
        case "instruct_several" | "instruct_every" | "reject_several":
            return _fit_of_several(move, situation, lists)
        case "ask_name" | "ask_find" if _asks_about_nothing_seen(move, lists):
            return 0.3  # "What is the capital of Mongolia?"
        case "relate" if _is_noun_of(move, lists):
            return 0.0  # "This is a waste of my time."
        case "instruct_some":
            return 0.3
        case "ask_deed" | "ask_beyond" | "define" | "count_sort":
            return 0.5
        case "okay":
            return 0.9 if situation.asks_whether else 1.0
        case "classify" if any(it.rule == "also" for it in parts(move)):
            return 1.8  # "Forks are tools, and so are spoons."
        case "classify" if _says_nothing(move):
            return 0.0  # "A cup's a cup."
        case "classify":
            hows = _words_of(move, "superkind")
            return 0.0 if any(_says_how(it, situation, lists) for it in hows) else 1.0
        case "kinds_too":
            return 1.2  # "they are cups", of kinds
        case "generalise":
            hows = _words_of(move, "property")
            return 1.0 if all(_says_how(it, situation, lists) for it in hows) else 0.5
        case "meant" | "meant_so":
            how = all(_says_how(it, situation, lists) for it in new_words(move))
            return 1.0 if how == (rule == "meant_so") else 0.2
        case "attend":
            known = all(_is_known(it, situation) for it in new_words(move))
            return 1.5 if known else 0.0
        case "correct_thing" if situation.asks_which:
            return 0.0
        case "correct_thing":
            known = all(_is_known(it, situation) for it in new_words(move))
            return 1.5 if known else 1.0  # "I meant the can."
        case "choice":
            return 2.0
        case "choice_colour":
            named = all(it in situation.colours for it in new_words(parts(move)[1]))
            return 2.0 if named else 0.0
        case "named":
            how = all(_says_how(it, situation, lists) for it in new_words(move))
            return (
                1.0 if how == (move.rule == "describe") or _has_article(move) else 0.2
            )
        case "ordered":
            return 1.2
        case "ask_difference":
            return 3.0  # it goes on after an "and"
        case "denied_word":
            return 1.0 if all(it in situation.known for it in new_words(move)) else 0.0
        case "correct":
            return _fit_of_contrast(move, situation, lists)
        case "instruct" if len(parts(move)) == 1:
            return 0.6
    return 1.0


def _asks_about_nothing_seen(move: Tree, lists: WordLists) -> bool:
    """Whether a question is about what nobody can see: "the capital of Mongolia"."""
    heads = [_head(it) for it in _parts_by(move, "noun")]
    return any(it in lists.abstract for it in heads)


def _head(noun: Tree) -> str:
    """The word of a noun that says what it is: the last, or the one before "of"."""
    before = takewhile(lambda it: it.terminal != "OF", words(noun))
    return [it.text.lower() for it in before][-1]


def _is_noun_of(move: Tree, lists: WordLists) -> bool:
    """Whether what is read as a relation is an article and a noun before "of"."""
    for relation in _parts_by(move, "relation"):
        first, *others = words(relation)
        terminals = {it.terminal for it in others[:-1]}
        if first.text.lower() in lists.articles and terminals == {"WORD"}:
            return True
    return False


def _parts_by(tree: Tree, rule: str) -> Iterable[Tree]:
    """The parts that are made by a rule, and those within others."""
    for it in parts(tree):
        if it.rule == rule:
            yield it
        else:
            yield from _parts_by(it, rule)


def _says_nothing(move: Tree) -> bool:
    """Whether a kind is said to be a kind of itself."""
    one, other = ([*_words_of(move, it)] for it in ("subkind", "superkind"))
    return one == other


def _fit_of_contrast(move: Tree, situation: Situation, lists: WordLists) -> float:
    """How well it fits to take bare words that are opposed for nouns, or for qualities.

    "Whistle, not thistle" corrects a noun, and "metal, not plastic" how a thing is.
    """
    said, *others = parts(move)
    if [it.rule for it in others] != ["denied"]:
        return 1.0
    denied = [*new_words(others[0])]
    new = [*new_words(said)]
    opposed = any(it in situation.qualities for it in (*denied, *new))
    if opposed or all(_says_how(it, situation, lists) for it in denied):
        how = True
    elif any(it in situation.known for it in denied):
        how = False
    else:
        how = all(_says_how(it, situation, lists) for it in (*denied, *new))
    is_how = said.rule == "having"
    return 1.0 if how == is_how or _has_article(move) else 0.2


def _has_article(tree: Tree) -> bool:
    """Whether some word in a part is an article."""
    return any(
        _has_article(it) if isinstance(it, Tree) else it.terminal == "A"
        for it in tree.children
    )


def _fit_of_several(move: Tree, situation: Situation, lists: WordLists) -> float:
    """How well it fits to say of several things what they are, or how they are."""
    nouns = [it for noun in _parts_by(move, "noun") for it in words(noun)]
    if any(
        it.terminal == "MASS" and not _is_noun(it.text, situation, lists)
        for it in nouns
    ):
        return 0.0  # "These are floppy."
    kinds = [*_words_of(move, "noun")]
    hows = kinds or _words_of(move, "adjective")
    says_how = all(
        _says_how_of_all(it, situation, lists)
        or (not kinds and it in lists.materials)  # "All of them are made of glass."
        for it in hows
    )
    if kinds:
        return 0.1 if says_how else 1.0
    return 0.5 if says_how else 0.0


def _is_noun(word: str, situation: Situation, lists: WordLists) -> bool:
    """Whether a word is a noun for things, as far as is known."""
    form = word.lower()
    return form in lists.things or form in situation.known - situation.qualities


def _is_known(word: str, situation: Situation) -> bool:
    """Whether a word is known, or is one with an ending: "koppen"."""
    return word.startswith(tuple(situation.known))


def new_words(tree: Tree) -> Iterable[str]:
    """The words in a part that may be learned, part by part."""
    for child in tree.children:
        if isinstance(child, Tree):
            yield from new_words(child)
        elif child.terminal not in ("A", "PREP", "OF", "SIDE", "ARTICLE"):
            yield child.text.lower()


def _words_of(tree: Tree, rule: str) -> Iterable[str]:
    """The words in the parts that are made by a rule."""
    for it in parts(tree):
        if it.rule == rule:
            yield from new_words(it)
        else:
            yield from _words_of(it, rule)


def _says_how(form: str, situation: Situation, lists: WordLists) -> bool:
    """Whether a word says how a thing is, rather than what: "Forks are sharp."."""
    return form in situation.qualities or not lists.judge_quality(form)


def _says_how_of_all(form: str, situation: Situation, lists: WordLists) -> bool:
    """Whether a word says how things are, in the form for several: Swedish "röda"."""
    return any(_says_how(it, situation, lists) for it in (form, form.removesuffix("a")))


def _has_part(tree: Tree, rule: str) -> bool:
    """Whether a part, or a part of it, is made by a rule."""
    return any(it.rule == rule or _has_part(it, rule) for it in parts(tree))
