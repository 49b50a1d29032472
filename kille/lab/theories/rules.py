"""The rules of a theory: the games of tutoring, less some rules, and with one's own."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from kille.dialogue.games import TUTORING
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.rules import NamedRule, bind
from kille.lab.errors import TheoryError
from kille.lab.settings import suggest_name, why_no_file
from kille.lab.study import Theory
from kille.lab.theories.meanings import meanings_of
from kille.lab.user_code import (
    OwnCodeError,
    describe_exception,
    failing_line,
    load_object,
)
from ttr import TTRError
from ttr.safety.consent import OWN_FOLDER, Consent
from ttr.theories.theory import load
from ttr.updates import (
    Algorithm,
    ByClass,
    Maybe,
    Repeat,
    Rule,
    Seq,
    replace_rules,
    rules_of,
    seq,
)

_WRITTEN = "FILE.ttr or FILE.py:NAME"

_NOTHING = seq()
"""What always applies, and changes nothing."""


def algorithm_of(theory: Theory) -> Algorithm:
    """The games as the theory has them; `TheoryError` where its rules cannot be used.

    A Python file is run anew each time, so that what its rules draw by chance does not
    depend on what was played before.
    """
    whole = _all_rules(theory)
    if not theory.without:
        return whole
    for told in _missing_rules(theory, whole):
        raise TheoryError(told)
    left = without_rules(whole, theory.without)
    if left is None:
        raise TheoryError(f"without {', '.join(theory.without)} nothing ever applies")
    return left


def missing_rules(theory: Theory) -> Iterator[str]:
    """Rules to be left out that are unknown; `TheoryError` as `algorithm_of`."""
    yield from _missing_rules(theory, _all_rules(theory))


def _missing_rules(theory: Theory, whole: Algorithm) -> Iterator[str]:
    known = [one.name for one in rules_of(whole)]
    for name in theory.without:
        if name not in known:
            yield f"there is no rule {name}: {suggest_name(name, known)}"


def _all_rules(theory: Theory) -> Algorithm:
    """The algorithm with the user's rules, on the types of the theory."""
    types = meanings_of(theory)
    usual = bind(TUTORING, types)
    if not theory.rules:
        return usual
    own = _add_own_rules(usual, theory)
    try:
        return bind(own, types)
    except (KeyError, TypeError) as error:
        told = str(error.args[0])
        raise TheoryError(
            f"{told}, which a rule names", _where(theory, told)
        ) from error


def _where(theory: Theory, told: str) -> str:
    """The line of the user's file on which a name stands that is told of."""
    path = Path(theory.rules.rpartition(":")[0])
    try:
        lines = path.read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return ""
    names = re.findall(r"\w+", told)
    found = (
        number
        for number, line in enumerate(lines, 1)
        if any(f'"{it}"' in line or f"'{it}'" in line for it in names)
    )
    return f"{path}:{next(found, 1)}"


def moves_said(theory: Theory) -> tuple[str, ...]:
    """The moves that the user's rules are known to plan; errors as `algorithm_of`."""
    if not theory.rules:
        return ()
    own = rules_of(_add_own_rules(bind(TUTORING, meanings_of(theory)), theory))
    said = (it for one in own if isinstance(one, NamedRule) for it in one.says)
    return tuple(dict.fromkeys(said))


def without_rules(algorithm: Algorithm, names: Collection[str]) -> Algorithm | None:
    """The algorithm in which these rules never apply; None if nothing is left.

    >>> from kille.dialogue.games.naming import NAMING
    >>> wild = ["see_nothing", "guess_wildly", "cannot_guess"]
    >>> print(without_rules(NAMING, ["recognise", "hedge_name", "guess_name", *wild]))
    seq(first(assert_name, doubt_name, admit_name))
    """
    match algorithm:
        case Rule():
            return None if algorithm.name in names else algorithm
        case Maybe(part):
            left = without_rules(part, names)
            return _NOTHING if left is None else Maybe(left)
        case Repeat(part):
            left = without_rules(part, names)
            return None if left is None else dataclasses.replace(algorithm, part=left)
        case ByClass(classes):
            few = [
                (k, tuple(r for r in rs if r.name not in names)) for k, rs in classes
            ]
            return ByClass(tuple(few)) if any(rules for _, rules in few) else None
        case Seq(parts):
            both = [without_rules(part, names) for part in parts]
            if None in both:
                return None
            return Seq(tuple(it for it in both if it is not None and it != _NOTHING))
    some = [without_rules(part, names) for part in algorithm.parts]
    parts = tuple(it for it in some if it is not None)
    return dataclasses.replace(algorithm, parts=parts) if parts else None


def describe_rule(rule: Rule, packaged: Collection[Rule]) -> str:
    """A rule to be read: in the notation, or as its Python code.

    Of the `packaged` rules it is what they are for.
    """
    if rule.text:
        return f"rule {rule.text}"
    if rule in packaged:
        return rule.doc
    try:
        code = inspect.getsource(getattr(rule.effect, "func", rule.effect))
    except (OSError, TypeError):  # a file that has gone, or no function of a file
        return rule.doc
    return inspect.cleandoc(code)


def packaged_rules(types: DialogueTypes) -> frozenset[Rule]:
    """The packaged rules of tutoring, on these types."""
    return frozenset(rules_of(bind(TUTORING, types)))


# --- rules of one's own ---------------------------------------------------------------


def _add_own_rules(whole: Algorithm, theory: Theory) -> Algorithm:
    """Put the user's rules of a theory in the place of those of their names."""
    reference, consent = theory.rules, theory.consent
    if reference.endswith(".ttr"):
        return _put_in_place(
            whole, _read_theory_rules(Path(reference), consent), reference
        )
    found = _run_python(reference, consent)
    if isinstance(found, Algorithm) and not isinstance(found, Rule):
        return found
    if callable(found) and not isinstance(found, Rule):
        return _apply_change(found, whole, reference)
    return _put_in_place(whole, _rules_by_name(found, reference), reference)


def _read_theory_rules(file: Path, consent: Consent | None) -> Mapping[str, Rule]:
    """The rules of a theory file, by those that they replace.

    Many a rule there cannot have the name of the other, which is that of a predicate:
    then it is of its kind, `rule silent(…) of admit_name`.
    """
    _check_there(file)
    try:
        rules = _load_rules(file, file.stat().st_mtime_ns, consent or OWN_FOLDER)
    except TTRError as error:
        place = f"{error.span.source}:{error.span.line}" if error.span else ""
        hint = f" ({error.hint})" if error.hint else ""
        raise TheoryError(f"{error.message}{hint}", place) from error
    return _check_single([(it.kind or it.name, it) for it in rules.values()], str(file))


def _check_single(rules: Iterable[tuple[str, Rule]], of: str) -> Mapping[str, Rule]:
    """Rules by the names that they replace; `TheoryError` if two replace one."""
    found: dict[str, Rule] = {}
    for name, one in rules:
        if name in found:
            both = f"both {found[name]} and {one} stand in place of {name}"
            raise TheoryError(f"{of}: {both}: write one, or rules in Python")
        found[name] = one
    return found


@lru_cache
def _load_rules(file: Path, _: int, consent: Consent) -> Mapping[str, Rule]:
    """The rules of a theory file as it was when it was changed last."""
    return load(file, allow=consent.folders).rules


def _run_python(reference: str, consent: Consent | None) -> Any:
    path, colon, _ = reference.rpartition(":")
    if not colon or not path.endswith(".py"):
        raise TheoryError(f"rules are named {_WRITTEN}, found {reference}")
    try:
        return load_object(reference, Path(), "_rules_", consent)
    except OwnCodeError as error:
        at = f"{path}:{error.line or 1}" if error.__cause__ is not None else ""
        raise TheoryError(error.message, at) from error


def _check_there(file: Path) -> None:
    if told := why_no_file(file):
        raise TheoryError(told)


def _apply_change(
    change: Callable[[Algorithm], Any], whole: Algorithm, of: str
) -> Algorithm:
    """Let a user's function change the algorithm."""
    try:
        made = change(whole)
    except (Exception, SystemExit) as error:
        path = of.rpartition(":")[0]
        at = f"{path}:{failing_line(path, error) or 1}"
        raise TheoryError(f"{of} failed: {describe_exception(error)}", at) from error
    if isinstance(made, Algorithm):
        return made
    raise TheoryError(f"{of} gives no rules: expected an algorithm, found {made!r}")


def _rules_by_name(found: object, reference: str) -> Mapping[str, Rule]:
    """Rules by the names of those that they replace."""
    match found:
        case Rule():
            return {found.name: found}
        case list() | tuple() if all(isinstance(it, Rule) for it in found):
            return _check_single([(it.name, it) for it in found], reference)
        case dict() if all(isinstance(it, Rule) for it in found.values()):
            return found
    raise TheoryError(
        f"{reference} is no rules: expected a rule, several, a dict of them by the "
        "rules that they replace, an algorithm, or a function that gives one"
    )


def _put_in_place(
    whole: Algorithm, rules: Mapping[str, Rule], reference: str
) -> Algorithm:
    known = [one.name for one in rules_of(whole)]
    if not rules:
        raise TheoryError(f"{reference} has no rule")
    for name in rules:
        if name not in known:
            raise TheoryError(
                f"{reference}: there is no rule {name} that it could stand for: "
                f"{suggest_name(name, known)}"
            )
    return replace_rules(whole, rules)
