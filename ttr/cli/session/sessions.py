"""A session: a theory that grows statement by statement, and the model of its facts.

A session is a value. Each statement gives another session; a mistake gives none. Unlike
in a file, a name may be declared again: what rests on it then changes with it.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from pathlib import Path
from typing import TypeAlias

from ttr.computing.subtyping import Answer
from ttr.errors import MistakesError, NotationError, TTRError, UnsupportedError
from ttr.escapes import json_text
from ttr.judging.judgements import Judgement, Why
from ttr.judging.models import Model
from ttr.notation import syntax_trees as trees
from ttr.notation.parser import parse_statement
from ttr.notation.scanning import find_statements
from ttr.notation.syntax_trees import Source, Statement
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.safety.budgets import within_budget
from ttr.safety.consent import OWN_FOLDER, Consent, check_called
from ttr.safety.files import write_whole
from ttr.safety.inputs import read_text
from ttr.safety.limits import THEORY
from ttr.signature.signature import Expected, Given
from ttr.theories.statements import StatementReader, names_mentioned
from ttr.theories.strategy_statements import kinds_gathered
from ttr.theories.theory import Theory, theory_of_draft, theory_of_file, theory_of_text
from ttr.theories.theory_draft import Draft
from ttr.types.objects import Object
from ttr.types.paths import subterms
from ttr.types.printing import notation
from ttr.types.syntax import Basic, PType, TypeNode

INPUT = "<input>"
"""The source that is named where a mistake in a typed line is shown."""

LastAnswer: TypeAlias = Object | Judgement | Answer | None
"""The last answer: a value, a judgement or an answer about types."""


@dataclass(frozen=True)
class Entry:
    """A statement of a session: the names that it declares, and those it rests on.

    `kinds` are the kinds of its rules; `rests_on` has the kinds it gathers, too.
    """

    text: str
    declares: frozenset[str]
    rests_on: frozenset[str]
    kinds: frozenset[str] = frozenset()


@dataclass(frozen=True, eq=False)
class Session:
    """What was entered so far: `theory` and `model` are what the entries come to.

    `last` is the last answer, `before` the session before the last change, and `over`
    is true when the user is done. By `consent`, files may import from the folders of
    files that the user has named.
    """

    entries: tuple[Entry, ...] = ()
    theory: Theory = field(default_factory=Theory)
    model: Model = field(default_factory=Model, repr=False)
    last: LastAnswer = None
    before: Session | None = field(default=None, repr=False)
    over: bool = False
    consent: Consent = OWN_FOLDER

    def with_file(self, path: Path) -> Session:
        """The session after the user has named this file."""
        return replace(self, consent=self.consent.with_folders(path.parent))


# --- entering statements -------------------------------------------------------------


@within_budget
def declare(
    session: Session, tree: Statement, source: Source
) -> tuple[Session, frozenset[str]]:
    """The session with one more statement, and the names that changed with it.

    Raises `TTRError` for a mistake in it, for a fact that contradicts others, and where
    what rests on a name does not fit its new meaning.

    >>> kennel, _ = declare(Session(), *_parse_input("basic Ind"))
    >>> kennel, _ = declare(kennel, *_parse_input("Pair := [a : Ind, b : Ind]"))
    >>> kennel, changed = declare(kennel, *_parse_input("Ind := list(Type)"))
    >>> sorted(changed), str(kennel.theory.Pair)
    (['Ind', 'Pair'], '[a : list(Type), b : list(Type)]')
    """
    if isinstance(tree, trees.Import):
        session = session.with_file(Path(os.path.realpath(tree.path)))
        entries = (*session.entries, _make_entry(tree, source, Path(), session.consent))
        return _rebuild(session, entries, _theory_of(session, entries)), frozenset()
    entry = _make_entry(tree, source, Path(), session.consent)
    if _is_repetition(session, entry, tree):
        return session, frozenset()
    again = _redefined_names(session.theory, tree)
    if again or _is_gathered(session, entry):
        return _redeclare(session, entry, tree, source)
    theory = _theory_with(session.theory, session.entries, tree, source)
    return _extend(session, (*session.entries, entry), theory), frozenset()


def _is_repetition(session: Session, entry: Entry, tree: Statement) -> bool:
    """Does the session have this very statement already?

    A question is asked again. A fact or a chance may have another degree by now.
    """
    if isinstance(tree, trees.Question | trees.GivenFact | trees.GivenChance):
        return False
    return any(entry.text == one.text for one in session.entries)


def _theory_with(
    theory: Theory, entries: Iterable[Entry], tree: Statement, source: Source
) -> Theory:
    """The theory of the entries with one more statement."""
    draft = Draft.of(theory)
    draft.used.update(*(one.rests_on for one in entries))
    StatementReader(draft, source).declare(tree)
    return theory_of_draft(draft)


def _make_entry(
    tree: Statement, source: Source, folder: Path, consent: Consent
) -> Entry:
    """The statement as an entry; an import in it is relative to the folder."""
    if isinstance(tree, trees.Import):
        path = Path(os.path.realpath(folder / tree.path))
        try:
            check_called(folder / tree.path, ".ttr", tree.path)
            theory = theory_of_file(path, consent)
        except TTRError as error:
            raise error.at(source.span(tree)) from None
        kinds = _kind_marks(rule.kind for rule in theory.rules.values())
        text = f"import {json_text(str(path))}"
        return Entry(text, theory.names, frozenset(), kinds)
    text = _indent(_text_of(source, tree))
    rests_on = names_mentioned(tree) | _kind_marks(kinds_gathered(tree))
    return Entry(text, _declared_names(tree), rests_on, _kinds_of(tree))


def _kinds_of(tree: Statement) -> frozenset[str]:
    """The kind of the rule that a statement declares, if it has one."""
    match tree:
        case trees.RuleStatement(kind=trees.Word(_, _, kind)):
            return _kind_marks([kind])
    return frozenset()


def _kind_marks(kinds: Iterable[str]) -> frozenset[str]:
    """Kinds of rules as they stand in `rests_on`: written so that they are no names."""
    return frozenset(f"of {kind}" for kind in kinds)


def _is_gathered(session: Session, entry: Entry) -> bool:
    """Does a strategy gather the rules of a kind, of which the entry is one more?"""
    return any(entry.kinds & one.rests_on for one in session.entries)


def _indent(text: str) -> str:
    """The text with its further lines indented, as in a file."""
    first, *rest = text.split("\n")
    inner = (line if line[:1].isspace() else f"    {line}" for line in rest)
    return "\n".join((first, *inner))


def _declared_names(tree: Statement) -> frozenset[str]:
    """The names that a statement declares, or may declare in passing."""
    match tree:
        case trees.BasicNames(_, _, words) | trees.ObjectNames(_, _, words):
            return frozenset(word.text for word in words)
        case trees.Predicates(_, _, arities):
            return frozenset(arity.name.text for arity in arities)
        case (
            trees.Definition(_, _, word)
            | trees.RuleStatement(_, _, word)
            | trees.StrategyStatement(_, _, word)
            | trees.GameStatement(_, _, word)
        ):
            return frozenset((word.text,))
        case trees.GivenFact(_, _, trees.Name(_, _, (name,), None)):
            return frozenset((name,))
    return frozenset()


def _extend(session: Session, entries: tuple[Entry, ...], theory: Theory) -> Session:
    """The session with these entries and the theory that they make."""
    old = session.theory
    if _entailment_rules(theory) != _entailment_rules(old):
        return _rebuild(session, entries, theory)
    new = theory.givens[len(old.givens) :]
    model = reduce(_give, new, session.model)
    return replace(session, entries=entries, theory=theory, model=model)


def _entailment_rules(theory: Theory) -> tuple[object, ...]:
    """The parts of a theory after whose change earlier facts are judged again."""
    return theory.axioms, theory.exclusions, theory.opened


def _rebuild(session: Session, entries: tuple[Entry, ...], theory: Theory) -> Session:
    model = reduce(_give, theory.givens, Model(replace(theory, givens=())))
    return replace(session, entries=entries, theory=theory, model=model)


def _give(model: Model, given: Given | Expected) -> Model:
    try:
        return model.with_given(given)
    except TTRError as error:
        raise error.at(given.span) if given.span else error from None


def _theory_of(session: Session, entries: Iterable[Entry]) -> Theory:
    text = "\n".join(entry.text for entry in entries)
    return theory_of_text(text, "<session>", session.consent)


def _union(names: Iterable[frozenset[str]]) -> frozenset[str]:
    return frozenset().union(*names)


# --- names that are declared again ---------------------------------------------------


def _redefined_names(theory: Theory, tree: Statement) -> frozenset[str]:
    """The names that a statement gives another meaning.

    A fact gives none, nor does declaring a basic type or an object once more.
    """
    known = theory.names & _declared_names(tree)
    match tree:
        case trees.BasicNames():
            return known - frozenset(theory.basics)
        case trees.ObjectNames():
            return known - theory.objects
        case trees.GivenFact():
            return frozenset()
    return known


def _redeclare(
    session: Session, entry: Entry, tree: Statement, source: Source
) -> tuple[Session, frozenset[str]]:
    """The session with the entry in place of those that declared its names."""
    names = entry.declares
    ahead, behind = _split_entries(session.entries, names, entry.kinds)
    try:
        _theory_with(_theory_of(session, ahead), ahead, tree, source)
    except TTRError:
        _refuse_circle(names, entry.rests_on, _names_of(behind))
        raise
    return _replace_entries(session, ahead, (entry,), behind)


def _refuse_circle(
    names: frozenset[str], rests_on: frozenset[str], followers: frozenset[str]
) -> None:
    new, hint = _comma_separated(names), "give the new one another name"
    if rests_on & names:
        raise NotationError(f"{new} would rest on itself", hint=hint)
    if rests_on & followers:
        between = _comma_separated(rests_on & followers)
        raise NotationError(
            f"{new} would rest on {between}, which rests on {new}", hint=hint
        )


def _replace_entries(
    session: Session,
    ahead: Sequence[Entry],
    new: Sequence[Entry],
    behind: Sequence[Entry],
) -> tuple[Session, frozenset[str]]:
    """The session of these entries, and the names that the new ones change.

    Raises `TTRError` where one of those behind does not fit with the new ones.
    """
    names = session.theory.names & _names_of(new)
    entries = (*ahead, *new, *behind)
    try:
        after = _rebuild(session, entries, _theory_of(session, entries))
    except TTRError as error:
        first = error.errors[0] if isinstance(error, MistakesError) else error
        raise type(first)(
            f"{_comma_separated(names)} cannot change so: {first.message}",
            span=first.span,
            hint=first.hint,
        ) from None
    return after, (names | _names_of(behind)) - after.theory.objects


def _names_of(entries: Iterable[Entry]) -> frozenset[str]:
    return _union(one.declares for one in entries)


def _split_entries(
    entries: Iterable[Entry],
    names: frozenset[str],
    kinds: frozenset[str] = frozenset(),
) -> tuple[list[Entry], list[Entry]]:
    """The entries without declarations of the names, in two parts.

    First those that do not rest on the names and the kinds, then those that do, both in
    their order.
    """
    ahead: list[Entry] = []
    behind: list[Entry] = []
    changed = names | kinds
    for entry in entries:
        follows = bool(entry.rests_on & changed)
        left = _without(entry, names)
        (behind if follows else ahead).extend(left)
        if follows:
            changed |= _names_of(left)
        if follows or entry.declares & names:
            changed |= entry.kinds
    return ahead, behind


def _without(entry: Entry, names: frozenset[str]) -> tuple[Entry, ...]:
    """The entry without its declarations of the names; empty if nothing is left."""
    if not entry.declares & names:
        return (entry,)
    tree, source = _parse_input(entry.text)
    match tree:
        case trees.Import(_, _, path):
            raise NotationError(
                f"{_comma_separated(entry.declares & names)} is declared in {path}, "
                "which the session imports",
                hint="give the new one another name",
            )
        case trees.GivenFact():
            text = entry.text
        case trees.BasicNames(_, _, words):
            text = _declaration_of(
                "basic", [w for w in words if w.text not in names], source
            )
        case trees.ObjectNames(_, _, words, kind):
            text = _declaration_of(
                "object", [w for w in words if w.text not in names], source
            )
            text += f" : {_text_of(source, kind)}" * bool(text)
        case trees.Predicates(_, _, arities):
            left = [one for one in arities if one.name.text not in names]
            text = _declaration_of("pred", left, source)
        case _:
            text = ""
    return (replace(entry, text=text, declares=entry.declares - names),) * bool(text)


def _declaration_of(keyword: str, left: Sequence[trees.Part], source: Source) -> str:
    """The declaration of the parts that are left; empty without any."""
    written = ", ".join(_text_of(source, part) for part in left)
    return f"{keyword} {written}" if written else ""


def _text_of(source: Source, part: trees.Part) -> str:
    return source.text[part.start : part.end]


def _comma_separated(names: Iterable[str]) -> str:
    return ", ".join(sorted(names))


def _parse_input(text: str) -> tuple[Statement, Source]:
    source = Source.of(text, INPUT)
    return parse_statement(source, 0, len(source.text)), source


# --- witnesses -----------------------------------------------------------------------


@within_budget
def create_witness(session: Session, T: TypeNode) -> tuple[Session, Object]:
    """The session with the facts of a new witness of T, and the witness.

    Raises `RefusedError` where there can be no witness.
    """
    witness, model = session.model.create(T)
    for sit, kind, p in _atoms(model.judge(witness, T).why, CERTAIN):
        is_new = isinstance(sit, str) and sit not in session.theory.names
        if is_new or session.model.judge(sit, kind).p != p:
            fact = _fact_statement(session.theory, sit, kind, p)
            session, _ = declare(session, *_parse_input(fact))
    return session, witness


def _atoms(why: Why, p: Degree) -> Iterable[tuple[Object, TypeNode, Degree]]:
    """The judgements of basic types and ptypes on which a derivation of degree p rests.

    Under a negation, these are the refuted ones.
    """
    if why.p != p:
        return
    if not why.parts and isinstance(why.type, Basic | PType):
        yield why.sit, why.type, p
    other = REFUTED if p == CERTAIN else CERTAIN
    for part in why.parts:
        yield from _atoms(part, other if why.how == "none" else p)


def _fact_statement(theory: Theory, sit: Object, T: TypeNode, p: Degree) -> str:
    """The statement of a fact; objects whose names mean something else are quoted."""
    meant = theory.names - theory.objects
    named = (part for part in subterms([T]) if isinstance(part, str))
    unheard = [name for name in named if name not in theory.objects]
    degree = " = 0" * (p == REFUTED)
    kind = notation(T, (meant.union(unheard),))
    return f"given {notation(sit, (meant,))} : {kind}{degree}"


# --- files ---------------------------------------------------------------------------


def load_file(session: Session, path: Path) -> tuple[Session, frozenset[str]]:
    """The session with the statements of a file, and the names that changed.

    Raises `TTRError` for a file that cannot be read and for the mistakes in it.
    """
    session = session.with_file(path)
    theory = theory_of_file(path, session.consent)
    known = {entry.text for entry in session.entries}
    entries = _entries_of_file(path, session.consent)
    new = tuple(entry for entry in entries if entry.text not in known)
    if not session.entries:
        return _rebuild(session, new, theory), frozenset()
    kinds = _union(one.kinds for one in new)
    ahead, behind = _split_entries(session.entries, _names_of(new), kinds)
    return _replace_entries(session, ahead, new, behind)


def _entries_of_file(path: Path, consent: Consent) -> Iterator[Entry]:
    source = Source.of(read_text(path, THEORY), str(path))
    for start, end in find_statements(source.text):
        yield _make_entry(
            parse_statement(source, start, end), source, path.parent, consent
        )


def save_file(session: Session, path: Path) -> None:
    """Writes the statements, imports too, into a file that can be loaded again.

    In another session, imports from other folders must be allowed again. Raises
    `TTRError` where the file cannot be written.
    """
    try:
        folder = Path(os.path.realpath(path)).parent
        lines = [_with_relative_import(entry.text, folder) for entry in session.entries]
        write_whole(path, "".join(f"{line}\n" for line in lines))
    except ValueError:
        raise UnsupportedError(
            f"{path} cannot be written: it is no path of a file"
        ) from None


def _with_relative_import(text: str, folder: Path) -> str:
    """The statement; an import is written relative to the folder."""
    if not text.startswith("import"):
        return text
    tree, _ = _parse_input(text)
    if not isinstance(tree, trees.Import):
        return text
    return f"import {json_text(os.path.relpath(tree.path, folder))}"
