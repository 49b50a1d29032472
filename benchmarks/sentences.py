"""Odd sentences to the robot: all are answered, and only what was said is learned.

    python benchmarks/sentences.py [--count N] [--seed S] [--language en|sv]

The sentences that tutors type, the idioms, and the examples of the lexicon are cut,
shuffled, joined and filled with other words, and mixed with words and signs that were
drawn. They are said to a simulated robot in front of one to four things, in dialogues
of twenty turns. What is told, and ends with exit code 1:

    error     anything is raised
    silent    there is no answer
    unsaid    a word is learned that neither of them has said
    unreal    something is learned at once beside "if", "I wish" or "looks like"
    denied    something is learned at once, and not denied, right after a "not"

The same seed gives the same dialogues.
"""

from __future__ import annotations

import argparse
import sys
import time
import tomllib
import traceback
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import cache, lru_cache
from pathlib import Path
from random import Random
from typing import NamedTuple

from kille.dialogue.language import LANGUAGES, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import is_denial
from kille.dialogue.robust_reading.clause_words import Word, words_of
from kille.dialogue.word_lists import WordLists, word_lists
from kille.lab.robots.simulated import SimulatedRobot
from kille.lab.scenes.scene import Occasion
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.worlds import draw_world
from ttr import Record

DATA = Path(__file__).resolve().parent.parent / "tests/kille/dialogue"
TURNS = 20
"""How many sentences are said in a dialogue."""

ANSWERS = {
    "en": ("Yes.", "No.", "The left one.", "Why?", "What is this?", "Forget that."),
    "sv": ("Ja.", "Nej.", "Den vänstra.", "Varför?", "Vad är det här?", "Glöm det."),
}
SIGNS = "…!?,.;:-–'’\"()[]{}<>@#/\\|&%0123456789åäöéßıİſ\u0301\u200b\u202e\x00\x1b🙂"
JOINTS = (" ", ", ", ". ", " and ", " och ", " but ", " men ", " – ", "\n", "; ")


class Wrong(NamedTuple):
    """What is wrong with a turn."""

    what: str
    text: str
    told: str


@cache
def sentences(language: str) -> tuple[str, ...]:
    """The sentences that are altered."""
    found = list(lexicon(language).examples)
    listed = tomllib.loads((DATA / f"parts.{language}.toml").read_text("utf-8"))
    found += [it[0] for kind in listed["classes"] for it in kind["said"]]
    rows = (DATA / f"tutors/utterances_{language}.tsv").read_text("utf-8").splitlines()
    found += [it.split("\t")[2] for it in rows if it and not it.startswith("#")]
    found += (DATA / f"tutors/idioms_{language}.txt").read_text("utf-8").splitlines()
    return tuple(dict.fromkeys(found))


@cache
def vocabulary(language: str) -> tuple[str, ...]:
    """The words of these sentences, each as often as it is there."""
    return tuple(word for text in sentences(language) for word in text.split())


def odd_sentence(chance: Random, language: str) -> str:
    """A sentence that nobody has thought of."""
    words = vocabulary(language)
    match chance.randrange(10):
        case 0:
            return " ".join(chance.choices(words, k=chance.randint(1, 16)))
        case 1:
            text = chance.choice(sentences(language))
            return text + chance.choice(JOINTS) + chance.choice(sentences(language))
        case 2:
            return chance.choice(ANSWERS[language])
        case 3 if chance.random() < 0.3:
            return "".join(chance.choices(SIGNS, k=chance.randint(1, 30)))
    said = chance.choice(sentences(language)).split()
    for _ in range(chance.choice((0, 1, 1, 2, 3))):
        said = _alter(chance, said, words) or said
    text = " ".join(said)
    if chance.random() < 0.1:
        at = chance.randrange(len(text) + 1)
        text = text[:at] + chance.choice(SIGNS) + text[at + chance.randint(0, 1) :]
    return text.upper() if chance.random() < 0.02 else text


def _alter(chance: Random, said: list[str], words: Sequence[str]) -> list[str]:
    """The words of a sentence with one change."""
    at = chance.randrange(len(said))
    match chance.randrange(6):
        case 0:
            return [*said[:at], *said[at + 1 :]]
        case 1:
            return [*said[:at], chance.choice(words), *said[at + 1 :]]
        case 2:
            return [*said[:at], chance.choice(words), *said[at:]]
        case 3:
            other = chance.randrange(len(said))
            said = [*said]
            said[at], said[other] = said[other], said[at]
            return said
        case 4:
            return [*said[: at + 1], *said[at:]]
    return said[: at + 1]


def dialogue(seed: str, language: str, turns: int) -> Iterator[Wrong]:
    """What is wrong with a dialogue, up to the first error."""
    chance = Random(seed)
    world = draw_world(chance.randrange(1000))
    robot = SimulatedRobot(simulated_game(world, language=language), language)
    robot.see(Occasion("noun", world.point_at(chance.choice(world.in_view)), 1))
    texts: list[str] = []
    state = robot.see(Occasion("noun", world, 1)).state
    for _ in range(turns):
        text = odd_sentence(chance, language)
        texts.append(text)
        try:
            reply = robot.hear(text)
        except Exception:
            yield Wrong("error", text, traceback.format_exc(limit=-4))
            return
        if not reply.text.strip() and any(map(str.isalpha, text)):
            yield Wrong("silent", text, "")
        before, state = state, reply.state
        new = [it for it in state.private.lessons if it not in before.private.lessons]
        yield from _wrong_lessons(new, texts, before, language)
        texts.append(reply.text)


def _wrong_lessons(
    lessons: Iterable[Record], texts: Sequence[str], before: Record, language: str
) -> Iterator[Wrong]:
    """The lessons that the tutor has not given."""
    text, lists = texts[-1], word_lists(language)
    forms = {it.form for one in texts for it in words_of(one, lists)}
    said = {main for it in forms for main in _main_forms(it, language)}
    for it in lessons:
        missing = [word for word in it.sign.form.split() if not _is_said(word, said)]
        if missing:
            yield Wrong("unsaid", " / ".join(texts[-5:]), it.sign.form)
        if before.shared.qud or before.shared.pending:
            continue  # a yes, or a no, may have been the answer
        words = words_of(text, lists)
        if len(understand(text, language)) > 1:
            continue
        said_so = [one.form for one in words if one.phrase == 1]
        if lists.is_unreal([one for one in said_so if one not in lists.negations]):
            yield Wrong("unreal", text, it.sign.form)
        if not is_denial(it.content) and _is_denied(it.sign.form, words, lists):
            yield Wrong("denied", text, it.sign.form)


def _is_denied(form: str, words: Sequence[Word], lists: WordLists) -> bool:
    """Whether a word is only said right after a "not" within a clause."""
    first, *_ = form.split()
    said = [it for it in words if it.form not in lists.articles]
    found = [n for n, it in enumerate(said) if _is_said(first, [it.form])]
    return bool(found) and all(_is_denied_at(n, said, lists) for n in found)


def _is_denied_at(at: int, words: Sequence[Word], lists: WordLists) -> bool:
    """Whether a "not" stands before a word, and another word before that."""
    inside = [it for it in words[:at] if it.clause == words[at].clause]
    if not inside or inside[-1].form not in lists.negations:
        return False
    return any(it.form not in lists.negations for it in inside if not it.is_harmless)


@lru_cache(10_000)
def _main_forms(form: str, language: str) -> frozenset[str]:
    """The words of which this may be a form: "böcker" is of "bok"."""
    found = lexicon(language).inflections.values()
    return frozenset(
        (form, *(w for them in found for it in them for w in it.words(form)))
    )


def _is_said(word: str, said: Iterable[str]) -> bool:
    """Whether a word, in some form, is among what was said."""
    stem = word[: max(2, len(word) - 2)]
    return any(it.startswith(stem) or word.startswith(it[:3]) for it in said)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=2000, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    parser.add_argument("--language", choices=LANGUAGES)
    options = parser.parse_args()
    languages = [options.language] if options.language else LANGUAGES
    counts, start, count = Counter[str](), time.process_time(), 0
    for number in range(-(-options.count // (TURNS * len(languages)))):
        for language in languages:
            for wrong in dialogue(f"{options.seed} {number}", language, TURNS):
                counts[wrong.what] += 1
                print(language, number, *wrong, sep="\t", flush=True)
            count += TURNS
    spent = time.process_time() - start
    each = 1000 * spent / count
    print(
        f"{count} sentences, {spent:.0f} s of CPU, {each:.1f} ms each; {dict(counts)}"
    )
    sys.exit(1 if counts else 0)


if __name__ == "__main__":
    main()
