"""What the robot makes of what tutors really say, and what it learns of it.

    python benchmarks/tutors.py [--language en|sv] [--held] [--idioms] [--unjudged]
        [--all] [--only NUMBERS]

Each utterance of `tests/kille/dialogue/tutors/utterances_*.tsv` is said in its scene:
the events that stand before it are played first. An event is what `kille talk` takes:
a command, as in `@ place cup at -0.18 0.0` or `@ point 2`, or a sentence of the tutor.
What the robot answers, and which lessons are new, gives the class:

    wrong      it learned a word, or denied one, that `lessons_*.tsv` does not allow
    helpful    it did not understand, and says what could be said instead
    refused    it did not understand, and says no more than that
    understood it was understood, and `judged_*.tsv` calls the answer sensible
    odd        it was understood, and `judged_*.tsv` calls the answer none that helps
    unjudged   nobody has judged this answer yet

`judged_*.tsv` is about answers, word for word: another answer has to be judged anew.
With `--idioms`, how many of the idioms teach anything, in front of one thing. With
`--held`, the lists of the folder `held`, which were written by somebody who knew only
their form. They are no measure any more once somebody has read them who then changes
the grammar: whoever does so writes others.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from kille.agent.agent import Agent
from kille.dialogue.language import LANGUAGES
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import is_denial
from kille.dialogue.reference import thing_at
from kille.scene import Look
from ttr import Record

DATA = Path(__file__).resolve().parent.parent / "tests/kille/dialogue/tutors"
CLASSES = ("understood", "helpful", "refused", "odd", "wrong", "unjudged")
COMMAND = "@ "
EMPTY = "synthetic:empty?seed=5"


class Line(NamedTuple):
    """An utterance, what happens before it, and what a competent listener would do.

    The events are apart by `|`; the scene says in words what they bring about.
    """

    number: str
    events: str
    scene: str
    utterance: str
    act: str
    ideal: str


class Outcome(NamedTuple):
    """What came of an utterance."""

    line: Line
    answer: str
    learned: tuple[str, ...]
    kind: str


def rows(folder: Path, name: str) -> Iterator[list[str]]:
    """The rows of a file of data; none if there is no such file."""
    with suppress(FileNotFoundError):
        for row in (folder / name).read_text("utf-8").splitlines():
            if row and not row.startswith("#"):
                yield row.split("\t")


def play_events(robot: Agent, events: str) -> None:
    """Have all that stands before an utterance happen."""
    for it in filter(None, events.split(" | ")):
        if it.startswith(COMMAND):
            robot.do(it.removeprefix(COMMAND))
        else:
            robot.hear(it)


def ranks(look: Look) -> list[int]:
    """The place of each thing from the left, in the order of their numbers."""
    across = [it.region.box.left for it in look.percepts]
    return [sorted(across).index(left) for left in across]


def lessons(robot: Agent) -> Counter[str]:
    """The lessons of this robot, as `cup@1`: a word, and its place from the left."""
    view = robot.view
    places = [] if view is None else ranks(view.look)

    def told(it: Record) -> str:
        x = thing_at(it.content, "target") or "o1"
        at = int(x[1:]) - 1
        place = places[at] + 1 if at < len(places) else 1
        sign = "-" if is_denial(it.content) else ""
        return f"{sign}{it.sign.form}@{place}"

    return Counter(told(it) for it in robot.state.private.lessons)


def play(line: Line, language: str) -> tuple[str, tuple[str, ...], bool]:
    """Say a line in its scene: the answer, what changed, and if it was understood."""
    with Agent(EMPTY, language=language, scans=2) as robot:
        play_events(robot, line.events)
        before = lessons(robot)
        answer = robot.hear(line.utterance)
        new, gone = lessons(robot) - before, before - lessons(robot)
        said = robot.exchanges[-1].said
        understood = not said or any(it.judgement is not None for it in said)
        changes = (*sorted(new.elements()), *(f"forgot {it}" for it in sorted(gone)))
        return answer.replace("\n", " / "), changes, understood


def right_lessons(line: Line, extra: Mapping[str, Sequence[str]]) -> frozenset[str]:
    """The lessons that are right for a line, by `lessons_*.tsv`."""
    return frozenset(extra.get(line.number, ()))


def is_right(lesson: str, right: Iterable[str]) -> bool:
    """Whether a lesson is one of those allowed; `cup` allows any place."""
    return any(lesson == it or lesson.split("@")[0] == it for it in right)


def outcomes(language: str, folder: Path = DATA, only: str = "") -> Iterator[Outcome]:
    """What comes of every utterance of a language in the lists of a folder."""
    right = {it[0]: it[1].split(", ") for it in rows(folder, f"lessons_{language}.tsv")}
    judged = {(it[0], it[1]): it[2] for it in rows(folder, f"judged_{language}.tsv")}
    helps = lexicon(language).not_understood[0].split("{nearest}")[0][-12:]
    for row in rows(folder, f"utterances_{language}.tsv"):
        line = Line(*row)
        if only and line.number not in only.split(","):
            continue
        answer, changes, understood = play(line, language)
        new = [it for it in changes if not it.startswith("forgot ")]
        if not all(is_right(it, right_lessons(line, right)) for it in new):
            kind = "wrong"
        elif not understood:
            kind = "helpful" if helps in answer else "refused"
        else:
            kind = judged.get((line.number, answer), "unjudged")
        yield Outcome(line, answer, changes, kind)


def taught_by(texts: Iterable[str], language: str) -> Iterator[tuple[str, list[str]]]:
    """The texts that teach something in front of one thing, and what."""
    for text in texts:
        with Agent(EMPTY, language=language, scans=2) as robot:
            robot.do("show cup")
            robot.hear(text)
            if new := sorted(lessons(robot).elements()):
                yield text, new


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--language", choices=LANGUAGES)
    parser.add_argument("--idioms", action="store_true")
    parser.add_argument("--unjudged", action="store_true", help="only those to judge")
    parser.add_argument("--all", action="store_true", help="every line")
    parser.add_argument("--only", default="", metavar="NUMBERS")
    parser.add_argument("--held", action="store_true", help="the lists held back")
    options = parser.parse_args()
    folder = DATA / "held" if options.held else DATA
    for language in [options.language] if options.language else LANGUAGES:
        if options.idioms:
            texts = (folder / f"idioms_{language}.txt").read_text("utf-8").splitlines()
            found = list(taught_by(texts, language))
            for text, new in found:
                print(f"  {text}  {new}")
            print(f"{language}: {len(found)} of {len(texts)} idioms teach something")
            continue
        counts = Counter[str]()
        for it in outcomes(language, folder, options.only):
            counts[it.kind] += 1
            if options.all or (it.kind == "unjudged" and options.unjudged):
                learned = ", ".join(it.learned)
                print(
                    "\t".join((it.line.number, it.answer, it.kind, learned, *it.line))
                )
        print(language, *(f"{kind} {counts[kind]}" for kind in CLASSES), sep=", ")


if __name__ == "__main__":
    main()
