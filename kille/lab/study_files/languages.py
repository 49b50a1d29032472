"""Languages of one's own tried: whether grammar and lexicon read, and say something."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path
from string import Formatter
from typing import Any

from kille.dialogue.grammars import GrammarError
from kille.dialogue.language import LANGUAGES, grammar_text, understand
from kille.dialogue.language_files import FILES, STRATEGIES
from kille.dialogue.lexicon import Lexicon, lexicon
from kille.dialogue.parsing import Grammar
from kille.lab.settings import Key, Problem, suggest_name, why_no_folder
from kille.lab.study import Theory
from kille.lab.study_files.grammar_mistakes import explain_grammar_error
from kille.lab.study_files.problems import line_of, lines_of
from kille.lab.theories.games import language_of
from kille.lab.theories.meanings import meanings_of
from ttr import TTRError
from ttr.errors import suggestion
from ttr.safety.files import why_unread
from ttr.safety.inputs import read_text
from ttr.safety.limits import SETTINGS

_KEY: Key = ("grammar",)

_TRIED = {
    "en": (
        "This is a cup.",
        "What is this?",
        "Where is the red cup?",
        "This is to the left of the red one.",
        "No.",
        "Hello.",
    ),
    "sv": (
        "Det här är en kopp.",
        "Vad är det här?",
        "Var är den röda koppen?",
        "Det här är till vänster om den röda.",
        "Nej.",
        "Hej.",
    ),
}
"""What is said to see whether the theory has types for what the grammar finds."""

_ODD = (ValueError, TypeError, AttributeError, LookupError)
"""What becomes of tables that are not what a lexicon is made of."""


def language_problems(theory: Theory) -> Iterator[Problem]:
    """What is wrong with the grammar and the lexicon in a theory's own folder."""
    if theory.grammar is None:
        return
    if told := why_no_folder(theory.grammar):
        hint = ": name the folder that it is in" if theory.grammar.is_file() else ""
        yield Problem(_KEY, f"{told}{hint}")
        return
    own = [theory.grammar / file.format(theory.language) for file in FILES]
    if not any(file.is_file() for file in (*own, theory.grammar / STRATEGIES)):
        names = " or ".join(file.name for file in own)
        told = f"expected {names} in {theory.grammar}, found neither"
        yield Problem(_KEY, f"{told}{_other_language(theory)}")
        return
    grammar, words = own
    wrong = [*_lexicon_problems(theory, words)] if words.is_file() else []
    yield from wrong
    if grammar.is_file():
        texts = () if wrong else _TRIED[theory.language]
        yield from _grammar_problems(theory, grammar, texts)


def _other_language(theory: Theory) -> str:
    """A hint that the folder has files of another language; empty if not."""
    assert theory.grammar is not None
    for language in LANGUAGES:
        if any((theory.grammar / it.format(language)).is_file() for it in FILES):
            return f', but files of language = "{language}"'
    return ""


def _grammar_problems(
    theory: Theory, file: Path, texts: Iterable[str]
) -> Iterator[Problem]:
    language = language_of(theory)
    try:
        grammar = Grammar(grammar_text(language))
        grammar.check_terminals()
        grammar.parse("a")
    except (OSError, UnicodeDecodeError) as error:
        yield Problem(_KEY, why_unread(file.name, error), f"{file}:1")
        return
    except GrammarError as error:
        line, what = explain_grammar_error(error, read_text(file, SETTINGS))
        told = f"this grammar does not read: {what}"
        yield Problem(_KEY, told, f"{file}:{line}")
        return
    for text in texts:
        try:
            understand(text, language, types=meanings_of(theory))
        except GrammarError as error:
            told = f"this grammar cannot be used for “{text}”: {error}"
            yield Problem(_KEY, told, f"{file}:1")
            return
        except (TTRError, *_ODD) as error:
            told = f"this grammar makes of “{text}” what tutor.ttr has no type for: "
            yield Problem(_KEY, f"{told}{error}", f"{file}:1")
            return


def _lexicon_problems(theory: Theory, file: Path) -> Iterator[Problem]:
    packaged, at = lexicon(theory.language), f"{file}:1"
    try:
        own = lexicon(language_of(theory), theory.wording or "paper")
    except tomllib.TOMLDecodeError as error:
        where = f"{file}:{_line_in(error)}"
        yield Problem(_KEY, f"this lexicon is no TOML: {error}", where)
    except (OSError, UnicodeDecodeError) as error:
        yield Problem(_KEY, why_unread(file.name, error), at)
    except KeyError as error:
        told = f"this lexicon lacks {error.args[0]}, which that of the package has"
        yield Problem(_KEY, told, at)
    except _ODD as error:
        yield Problem(_KEY, f"this lexicon does not read: {error}", at)
    else:
        lines = lines_of(read_text(file, SETTINGS))
        moves = meanings_of(theory).theory.predicates
        for key, what in _wording_problems(own, packaged, moves):
            yield Problem(_KEY, what, f"{file}:{line_of(lines, key)}")


def _wording_problems(
    own: Lexicon, packaged: Lexicon, moves: Collection[str]
) -> Iterator[tuple[Key, str]]:
    """What is wrong with wordings, which are of moves or replace packaged ones."""
    tables = {
        section: acts
        for section, acts in own.sections.items()
        if section.startswith("says") and isinstance(acts, Mapping)
    }
    worded = {act for acts in tables.values() for act in acts}
    unknown = worded - {*moves, *packaged.wordings}
    meant = {it: suggestion(it, {*moves} - worded) for it in unknown}
    for table in ("says", "tells"):
        mine, theirs = getattr(own, table), getattr(packaged, table)
        lacking = sorted(theirs.keys() - mine.keys())
        if lacking and not any(meant.values()):
            yield (_FILED[table],), f"there is no wording for {', '.join(lacking)}"
    known = sorted({slot for it in packaged.wordings.values() for slot in _slots(it)})
    for section, acts in tables.items():
        for act, of_act in acts.items():
            several = of_act if isinstance(of_act, list) else [of_act]
            wrong = [*_slot_problems(several, known)]
            if not wrong and act in meant:
                told = f"there is no move {act}, which this is a wording of"
                wrong = [f"{told}: {meant[act]}" if meant[act] else told]
            yield from (((section, act), it) for it in wrong)


_FILED = {"says": "says", "tells": "tutor"}
"""What the tables of a lexicon are called in its file."""


def _slot_problems(wordings: list[Any], known: list[str]) -> Iterator[str]:
    """What is wrong with the wordings of a move, whatever TOML they are."""
    odd = [it for it in wordings if not isinstance(it, str)]
    if odd:
        yield f"a wording is a text or a list of texts, found {_kind_of(odd[0])}"
        return
    try:
        found = _slots(wordings)
    except ValueError as error:
        yield f"this wording does not read: {error}"
        return
    for slot in found:
        if slot not in known:
            yield f"there is no slot {{{slot}}}: {suggest_name(slot, known)}"


def _kind_of(value: object) -> str:
    """The kind of a TOML value, in words."""
    match value:
        case dict():
            return "a table"
        case list():
            return "a list in a list"
        case _:
            return str(value).lower()


def _slots(wordings: tuple[str, ...] | list[str]) -> list[str]:
    parsed = (part for wording in wordings for part in Formatter().parse(wording))
    return [slot for _, slot, _, _ in parsed if slot is not None]


def _line_in(error: Exception) -> str:
    found = re.search(r"line (\d+)", str(error))
    return found[1] if found else "1"
