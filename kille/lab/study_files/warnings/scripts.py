"""Scripts of tutors who say what nobody understands, or ask for untaught words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from itertools import takewhile

from kille.dialogue.language import Utterance, overhear, understand
from kille.dialogue.tutoring import hear
from kille.lab.settings import Problem, nearest_name
from kille.lab.study import PERSON, Study, Theory
from kille.lab.theories import language_of
from kille.lab.theories.meanings import meanings_of
from kille.lab.tutors.scripted import script_lines
from kille.lab.worlds.vocabulary import vocabulary
from ttr.dialogues.stories import Line
from ttr.types import PType


def script_warnings(study: Study) -> Iterator[Problem]:
    """What is probably not meant in the scripts of a study."""
    scripts = {
        name: script_lines(study.path(tutor.settings["file"]))
        for name, tutor in study.tutors.items()
        if tutor.kind == "scripted"
    }
    theories = [it for it in study.theories.values() if it.mode != PERSON]
    for name, lines in scripts.items():
        for told, line in (
            *_measure_warnings(lines),
            *_reading_warnings(lines, theories),
            *(
                _word_warnings(lines, scripts, theories[0])
                if _only_scripts_teach(study, theories)
                else ()
            ),
        ):
            yield Problem(("tutors", name, "file"), told, line.place)


def _measure_warnings(lines: Iterable[Line]) -> Iterator[tuple[str, Line]]:
    for line in lines:
        if line.mark in ("S~", "="):
            told = f"what {line.mark} expects is not measured: write S> and all of it"
            yield told, line


def _reading_warnings(
    lines: Sequence[Line], theories: Iterable[Theory]
) -> Iterator[tuple[str, Line]]:
    """Lines that a theory does not understand, where the script expects no reply."""
    for line, replies in _with_replies(lines):
        for theory in theories if not replies else ():
            language = language_of(theory)
            if hear(line.text, language, types=meanings_of(theory)) is None:
                yield f"{theory.name} does not understand “{line.text}”", line
                break


def _only_scripts_teach(study: Study, theories: Sequence[Theory]) -> bool:
    """Whether all that is taught in front of the robot is in the scripts."""
    kinds = {it.kind for it in study.tutors.values()} - {"scripted"}
    change = any(it.do == "change_tutor" for it in study.phases)
    return bool(theories) and not (kinds and (change or "several" in kinds))


def _word_warnings(
    lines: Sequence[Line], scripts: Mapping[str, Sequence[Line]], theory: Theory
) -> Iterator[tuple[str, Line]]:
    """Words that are asked for, and that no line of any script teaches.

    A script may mean that: then it has the robot reply that it does not know the word.
    """
    every = [it for script in scripts.values() for it in script]
    taught = _taught_words(every, theory)
    known = taught | _words_known_anyhow(theory)
    for line, replies in _with_replies(lines):
        asked = [it for it in _readings(line.text, theory) if _asks(it)]
        unknown = [
            [form for form in _forms(it) if form.split()[-1] not in known]
            for it in asked
        ]
        if all(unknown) and asked and not _is_expected(replies, theory):
            word = unknown[0][0]
            hint = nearest_name(word, taught, ": did you mean {}?")
            told = f"“{word}” is asked for, and no line teaches it"
            yield told + (hint or ": teach it, or take the line out"), line


def _taught_words(lines: Iterable[Line], theory: Theory) -> Set[str]:
    """What lines tell the robot, and the last words of that: cup of a red cup."""
    told = {
        form
        for line in lines
        if line.mark == "U>"
        for it in _readings(line.text, theory)
        if not _asks(it)
        for form in _forms(it)
    }
    return told | {it.split()[-1] for it in told}


def _words_known_anyhow(theory: Theory) -> Set[str]:
    words = vocabulary(theory.language, meanings_of(theory))
    signs = (*words.colours, *words.comparatives.values())
    return {str(it.form).split()[-1] for it in signs}


def _readings(text: str, theory: Theory) -> Iterator[Utterance]:
    said = understand(text, language_of(theory), types=meanings_of(theory))
    return (reading for one in said for reading in one.readings)


def _forms(said: Utterance) -> Iterator[str]:
    return (str(it.form) for it in said.signs)


def _asks(said: Utterance) -> bool:
    return _act(said).startswith("ask_")


def _is_expected(replies: Iterable[Line], theory: Theory) -> bool:
    """Whether the robot is to reply that it does not know a word."""
    heard = (overhear(it.text, language_of(theory)) for it in replies)
    return any(_act(it).startswith("unknown_") for said in heard for it in said)


def _act(said: Utterance) -> str:
    event = said.type["e"]
    return event.pred.name if isinstance(event, PType) else ""


def _with_replies(lines: Sequence[Line]) -> Iterator[tuple[Line, Sequence[Line]]]:
    """What the tutor says, each line with those that say what the robot replies."""
    for place, line in enumerate(lines):
        if line.mark == "U>":
            after = takewhile(lambda it: it.mark[0] == "S", lines[place + 1 :])
            yield line, tuple(after)
