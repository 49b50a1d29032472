"""Theories tried one by one: what of them cannot be used, before anything is played.

A theory must have the rules, the learners and the language that it names, and they must
pass their own checks: those of rules before they run, and what a theory file claims of
itself.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from kille.dialogue.language_files import FILES
from kille.dialogue.lexicon import lexicon
from kille.dialogue.tutoring import hear, tutoring
from kille.lab.errors import TheoryError
from kille.lab.results import ExperimentError
from kille.lab.settings import Key, Problem, why_no_file
from kille.lab.study import PERSON, Theory
from kille.lab.study_files.languages import language_problems
from kille.lab.study_files.learners import learner_problems
from kille.lab.study_files.problems import line_of, lines_of
from kille.lab.study_files.strategy_files import strategy_file_problems
from kille.lab.theories.games import (
    change_game,
    game_of,
    language_of,
    strategy_problems,
)
from kille.lab.theories.meanings import meanings_of
from kille.lab.theories.rules import missing_rules, moves_said, packaged_rules
from kille.lab.user_code import describe_exception, failing_line
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.worlds import Thing, World
from ttr import TTRError
from ttr.errors import MistakesError, Span
from ttr.safety.consent import OWN_FOLDER
from ttr.safety.inputs import read_text
from ttr.safety.limits import SETTINGS
from ttr.theories.checking import check
from ttr.theories.theory import load
from ttr.types import PType
from ttr.updates import Rule
from ttr.updates.checks import NEVER, Fault, faults_of

_OWN = ("meanings", "rules", "without", "learners")
"""What a theory may have of its own that fails only when it is played."""


def theory_problems(theory: Theory, eyes: Collection[str]) -> Iterator[Problem]:
    """All that is wrong with a theory that is `simulated`, or of the `whole` robot."""
    if theory.mode == PERSON:
        yield from _person_problems(theory)
        return
    if theory.meanings:
        yield from _meaning_problems(theory, eyes)
    else:
        yield from _other_problems(theory, eyes)


def _other_problems(theory: Theory, eyes: Collection[str]) -> Iterator[Problem]:
    """What is wrong with a theory whose meanings can be read."""
    found = [*strategy_file_problems(theory)] or [
        it.within("strategy") for it in strategy_problems(theory)
    ]
    found += learner_problems(theory, eyes)
    found += language_problems(theory)
    found += _rule_problems(replace(theory, strategy={}, grammar=None))
    found = found or [*_unworded_problems(theory)]
    yield from found
    if not found and any(getattr(theory, it) for it in _OWN):
        simulated = "simulated" in eyes
        yield from _trial_problems(
            theory if simulated else replace(theory, learners={})
        )


def _person_problems(theory: Theory) -> Iterator[Problem]:
    for key in ("strategy", "learners", "rules", "without", "grammar", "meanings"):
        if getattr(theory, key):
            told = f"{theory.name} is played by a person, who has no {key}"
            yield Problem((key,), told)


# --- meanings -------------------------------------------------------------------------


def _meaning_problems(theory: Theory, eyes: Collection[str]) -> Iterator[Problem]:
    """What is wrong with meanings of one's own, or else with what is made of them."""
    key: Key = ("meanings",)
    own = theory.meanings
    if isinstance(own, str) and (told := why_no_file(Path(own))):
        yield Problem(key, told)
        return
    try:
        if isinstance(own, str) and (
            failing := [*_failed_claims(key, Path(own), theory)]
        ):
            yield from failing
            return
        tutoring(types=meanings_of(theory))
        yield from list(_other_problems(theory, eyes))
    except TTRError as error:
        found = _problems_of_error(key, error)
        yield from found if isinstance(own, str) else _inline_problems(own, error)
    except Exception as error:
        told = f"the games cannot be made of it: {describe_exception(error)}"
        yield Problem(key, told, f"{own}:1" if isinstance(own, str) else "")


def _inline_problems(types: Mapping[str, str], error: TTRError) -> Iterator[Problem]:
    """Mistakes in types that are written in the study, each with its key."""
    for one in error.errors if isinstance(error, MistakesError) else (error,):
        line = one.span.text if one.span else one.message
        hint = f" ({one.hint})" if one.hint else ""
        yield Problem(_key_of(types, line), f"{one.message}{hint}")


def _key_of(types: Mapping[str, str], told: str) -> Key:
    """The key of the type that a message names; that of all types if it names none."""
    named = (it for it in re.findall(r"\w+", told) if it in types)
    return ("meanings", *list(named)[:1])


# --- rules ----------------------------------------------------------------------------


def _rule_problems(theory: Theory) -> Iterator[Problem]:
    if not (theory.rules or theory.without):
        return
    key: Key = ("rules",) if theory.rules else ("without",)
    try:
        of_file = theory.rules.endswith(".ttr")
        if (
            failing := [*_failed_claims(key, Path(theory.rules), theory)]
            if of_file
            else []
        ):
            yield from failing
            return
        if wanting := [Problem(("without",), it) for it in missing_rules(theory)]:
            yield from wanting
            return
        types = meanings_of(theory)
        game, packaged = (
            change_game(tutoring(types=types), theory),
            packaged_rules(types),
        )
        errors = (it for it in faults_of(game) if _is_error(it))
        wrong = (it for it in errors if not _is_moot(it, packaged))
        yield from (_problem_of_fault(key, it) for it in wrong)
    except TheoryError as error:
        yield Problem(key, error.message, error.at)
    except TTRError as error:
        yield from _problems_of_error(key, error)


def _unworded_problems(theory: Theory) -> Iterator[Problem]:
    """Moves that the user's rules plan, and the user's own lexicon has no wording of.

    Where there is no lexicon of one's own, the language may have no word that leads to
    such a move.
    """
    if theory.grammar is None:
        return
    file = theory.grammar / FILES[1].format(theory.language)
    if not file.is_file():
        return
    says, types = lexicon(language_of(theory)).says, meanings_of(theory)
    line = line_of(lines_of(read_text(file, SETTINGS)), ("says",))
    for move in moves_said(theory):
        event = types.record_type(move)["e"]
        if isinstance(event, PType) and event.pred.name not in says:
            told = f"there is no wording of {event.pred.name}, by which {move} is said"
            yield Problem(("grammar",), told, f"{file}:{line}")


def _problems_of_error(key: Key, error: TTRError) -> Iterator[Problem]:
    for one in error.errors if isinstance(error, MistakesError) else (error,):
        hint = f" ({one.hint})" if one.hint else ""
        yield Problem(key, f"{one.message}{hint}", _format_place(one.span))


def _failed_claims(key: Key, file: Path, theory: Theory) -> Iterator[Problem]:
    """The claims of a theory file that do not hold."""
    consent = theory.consent or OWN_FOLDER
    report = check(load(file, allow=consent.folders))
    for failure in report.failures:
        because = f", {failure.why}" if failure.why else ""
        told = f"{failure.check.text} does not hold: found {failure.found}{because}"
        yield Problem(key, told, _format_place(failure.check.span))
    yield from (_problem_of_fault(key, it) for it in report.faults if _is_error(it))


def _is_error(fault: Fault) -> bool:
    return fault.severity == "error"


def _is_moot(fault: Fault, packaged: Collection[Rule]) -> bool:
    """Whether a fault is of a packaged rule that the theory has no use for."""
    return fault.sort in NEVER and fault.rule in packaged


def _problem_of_fault(key: Key, fault: Fault) -> Problem:
    hint = f": {fault.hint}" if fault.hint else ""
    return Problem(key, f"{fault.message}{hint}", _format_place(fault.span))


def _format_place(span: Span | None) -> str:
    return "" if span is None else f"{span.source}:{span.line}"


# --- a first dialogue -----------------------------------------------------------------

_THINGS = Thing("cup", "red", 0.9, (2, 3)), Thing("car", "blue", 0.1, (7, 3))

_SAID = {
    "en": (
        (1, "This is a cup.", "This is big.", "What is this?"),
        (1, "This is red.", "What colour is this?"),
        (2, "This is a car.", "This is to the right of the cup.", "Where is this?"),
        (2, "What is this?", "No, it is a mug.", "Forget that.", "What is this?"),
    ),
    "sv": (
        (1, "Det här är en kopp.", "Det här är stort.", "Vad är det här?"),
        (1, "Det här är rött.", "Vilken färg har det här?"),
        (2, "Det här är en bil.", "Det här är till höger om koppen."),
        (2, "Var är det här?", "Vad är det här?", "Nej, det är en mugg."),
        (2, "Glöm det.", "Vad är det här?"),
    ),
}
"""The number of a thing that is pointed at, and what is said of it, by the language."""


def _trial_problems(theory: Theory) -> Iterator[Problem]:
    """Why a theory fails at a few sentences, whatever its own code raises."""
    world = World(_THINGS)
    text = ""
    try:
        game = game_of(theory, world, colours=())  # else no colour is ever judged
        now = game.begin()
        for number, *texts in _SAID[theory.language]:
            event, world = (
                glance_event(world.point_at(number), world),
                world.point_at(number),
            )
            now = game.take(now, event).run
            for text in texts:
                heard = hear(text, language_of(theory), types=meanings_of(theory))
                now = now if heard is None else game.take(now, heard).run
    except (Exception, SystemExit) as error:
        cause = _first_cause(error)
        key: Key = (next(it for it in _OWN if getattr(theory, it)),)
        if isinstance(theory.meanings, Mapping):
            key = _key_of(theory.meanings, str(cause))
        where = f"fails at “{text}”" if text else "cannot begin"
        yield Problem(key, f"tried out, it {where}: {_describe_cause(cause, theory)}")


def _describe_cause(error: BaseException, theory: Theory) -> str:
    """The message of an error; in the user's rules with its class and line."""
    file = theory.rules.rpartition(":")[0]
    line = failing_line(file, error)
    if line:
        return f"{describe_exception(error)} ({Path(file).name}, line {line})"
    return next(iter(str(error).splitlines()), type(error).__name__)


def _first_cause(error: BaseException) -> BaseException:
    """The error that caused all others, up to a learner's, which names it."""
    while error.__cause__ is not None and not isinstance(error, ExperimentError):
        error = error.__cause__
    return error
