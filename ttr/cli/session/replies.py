"""Replies to what is typed into a session: statements, questions and terms."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from ttr.building.merging import amerge, merge
from ttr.building.relabelled_subtyping import subtype_up_to_relabelling
from ttr.cli.session.sessions import INPUT, LastAnswer, Session, create_witness, declare
from ttr.computing.normalisation import normal_value
from ttr.computing.subtyping import subtype
from ttr.display.abbreviations import abbreviator
from ttr.errors import NotationError, Span, TTRError
from ttr.judging.judgements import Why
from ttr.notation import syntax_trees as trees
from ttr.notation.parser import parse_statement
from ttr.notation.reader import Reader, read_term
from ttr.notation.scanning import check_characters
from ttr.notation.syntax_trees import Application, Name, Source, Statement
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import within_budget
from ttr.theories.check_statements import CheckReader
from ttr.theories.checking import answer_checks
from ttr.theories.game_opening import open_games
from ttr.theories.queries import Check, IsBelow, IsBelowRelabelled, IsOf
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.syntax import TypeNode, as_type
from ttr.updates.rule_application import apply_rule
from ttr.updates.rule_notation import declaration

_MERGES = {"merge": merge, "amerge": amerge}

ASKED = (*_MERGES, "create", "wellformed", "witnesses", "P")
"""Words for questions about types, written like an application."""

_CHECK = "check "


@dataclass(frozen=True)
class Reply:
    """The text of a reply, and the session after it."""

    session: Session
    text: str = ""


@within_budget
def answer(session: Session, text: str) -> Reply:
    """The reply to a statement, a question or a term; raises `TTRError`.

    >>> kennel = answer(Session(), "basic A, B").session
    >>> print(answer(kennel, "A <= B").text)
    no: A is not below B
    counter-example: a1
    """
    source = Source.of(text, INPUT)
    check_characters(source)
    try:
        tree = parse_statement(source, 0, len(source.text))
    except NotationError as mistake:
        return _answer_question(session, source, mistake)
    return _declare(session, tree, source)


@within_budget
def evaluate_term(session: Session, text: str) -> Object:
    """The type or object that a text stands for, with its applications computed."""
    return session.model.reduce(read_term(text, session.theory, INPUT))


def list_changes(names: Iterable[str]) -> str:
    """The line that names have changed their meaning; empty without names."""
    listed = ", ".join(sorted(names))
    return f"changed: {listed}" if listed else ""


def _declare(session: Session, tree: Statement, source: Source) -> Reply:
    """The session with the statement; a check that fails is not kept."""
    after, changed = declare(session, tree, source)
    if changed or isinstance(tree, trees.GameStatement):
        # Refuses a game that starts from what is no state of it.
        open_games(after.theory)
    if not isinstance(tree, trees.Question):
        return Reply(replace(after, before=session), list_changes(changed))
    newest = replace(after.theory, checks=after.theory.checks[-1:])
    report = answer_checks(newest, after.model)
    if not report.holds:
        return Reply(session, str(report))
    return Reply(replace(after, before=session), "it holds")


# --- questions -----------------------------------------------------------------------


def _answer_question(session: Session, source: Source, mistake: NotationError) -> Reply:
    """The reply to a text that is no statement, as the mistake says.

    The grammar knows questions as checks, so the text is read as a check.
    """
    asked = Source(_CHECK + source.text, source.name)
    try:
        tree = parse_statement(asked, 0, len(asked.text))
    except NotationError as error:
        raise _furthest(mistake, _without_check_hint(_without_prefix(error))) from None
    try:
        return _answer_tree(session, tree, Reader(session.theory, asked))
    except TTRError as error:
        raise _without_prefix(
            _with_definition_hint(error, tree, asked, mistake)
        ) from None


def _with_definition_hint(
    error: TTRError, tree: Statement, source: Source, mistake: NotationError
) -> TTRError:
    """The error; for an unknown name before `=`, with a hint how to define names.

    `mistake` says why the text is no definition.
    """
    match tree:
        case trees.Question(
            _, _, _, trees.Comparison(_, _, "=", Name(_, _, (_,), None) as name)
        ) if error.span == source.span(name):
            near = error.hint if error.hint.startswith("did you mean") else ""
            hint = " ".join(filter(None, (near, mistake.hint)))
            return type(error)(error.message, span=error.span, hint=hint)
    return error


def _without_prefix(error: TTRError) -> TTRError:
    """The error with its place in the text as typed, without the word `check`."""
    span = error.span
    if span is None or span.source != INPUT or span.line > 1:
        return error
    before = len(_CHECK)
    column = max(1, span.column - before)
    length = min(span.column - 1 + span.length - before, span.length)
    moved = Span(INPUT, 1, column, max(1, length), span.text[before:])
    return type(error)(error.message, span=moved, hint=error.hint)


def _without_check_hint(error: TTRError) -> TTRError:
    """The error without a hint about the word `check`, which nobody typed."""
    hint = "" if _CHECK.strip() in error.hint else error.hint
    return type(error)(error.message, span=error.span, hint=hint)


def _furthest(statement: TTRError, question: TTRError) -> TTRError:
    """Of two ways to read a text, the mistake of the one that came further.

    Where both came equally far, it is the one with a hint.
    """
    return max(question, statement, key=lambda one: (_position(one), bool(one.hint)))


def _position(error: TTRError) -> tuple[int, int]:
    return (error.span.line, error.span.column) if error.span else (0, 0)


def _answer_tree(session: Session, tree: Statement, reader: Reader) -> Reply:
    match tree:
        case trees.Question(_, _, "yes", trees.Claim(_, _, claim)):
            return _answer_term(session, claim, reader)
        case trees.Question(_, _, "yes", trees.Probability(degree=None) as asked):
            return _answer_probability(session, asked, reader)
        case trees.Question(_, _, "yes", trees.Expectation(degree=None) as asked):
            return _answer_expectation(session, asked, reader)
        case trees.Question(_, _, "yes"):
            return _answer_check(session, CheckReader(reader).check(tree))
    reader.refuse(
        tree,
        "a question is asked as it is: the answer says yes, no or unknown",
        "to claim what the answer is, put the word check before it",
    )


def _answer_check(session: Session, question: Check) -> Reply:
    query, model = question.query, session.model
    match query:
        case TTRError():
            raise query
        case IsOf(sit, T):
            return _judge(session, model.reduce(sit), _reduced_type(session, T))
        case IsBelow(lower, upper):
            return _compare_types(
                session, _reduced_type(session, lower), _reduced_type(session, upper)
            )
        case IsBelowRelabelled(lower, upper):
            S, T = _reduced_type(session, lower), _reduced_type(session, upper)
            answer = subtype_up_to_relabelling(S, T, session.theory)
            return Reply(replace(session, last=answer), str(answer))
    report = answer_checks(replace(session.theory, checks=(question,)), session.model)
    if report.holds:
        return Reply(session, "yes")
    (failure,) = report.failures
    if failure.found == "error":
        raise TTRError(failure.why)
    found = failure.why if failure.found == "no" else failure.found
    return Reply(session, f"no: {found}")


def _reduced_type(session: Session, T: TypeNode) -> TypeNode:
    return as_type(session.model.reduce(T))


def _judge(session: Session, sit: Object, T: TypeNode) -> Reply:
    judgement = session.model.judge(sit, T)
    text = f"{_verdict(judgement.p)}: {_deciding_step(judgement.why)}"
    return Reply(replace(session, last=judgement), text)


def _answer_probability(
    session: Session, asked: trees.Probability, reader: Reader
) -> Reply:
    """p(a : T | b : S), and what it is computed from."""
    model = session.model
    sit, T = reader.object(asked.sit, ()), reader.type(asked.type, ())
    when = [(reader.object(one, ()), reader.type(S, ())) for one, S in asked.when]
    conditions = [(model.reduce(one), _reduced_type(session, S)) for one, S in when]
    judgement = model.judge(
        model.reduce(sit), _reduced_type(session, T), when=conditions
    )
    text = f"{judgement.p}: {judgement.why.because}"
    return Reply(replace(session, last=judgement), text)


def _answer_expectation(
    session: Session, asked: trees.Expectation, reader: Reader
) -> Reply:
    """p(T || S), over the known objects."""
    T, *types = [
        _reduced_type(session, reader.type(one, ()))
        for one in (asked.type, *asked.when)
    ]
    return Reply(session, str(session.model.chance(T, when=types)))


def _verdict(p: Degree) -> str:
    """The answer in one word, or the degree."""
    words = {CERTAIN: "yes", REFUTED: "no", UNKNOWN: "unknown"}
    return words.get(p, f"p = {p}")


def _deciding_step(why: Why) -> str:
    """The step that decides a derivation, on one line."""
    step = why.failure() or why
    said = step.because
    if step is why:
        return said
    path = why.path()
    where = f"{path}: " if path else ""
    return f"{where}{notation(step.sit)} : {step.type} ({said})"


def _compare_types(session: Session, S: TypeNode, T: TypeNode) -> Reply:
    answer = subtype(S, T, session.theory)
    counter = answer.counter
    lines = [str(answer)]
    if counter is not None:
        lines.append(f"counter-example: {notation(counter.sit)}")
    return Reply(replace(session, last=answer), "\n".join(lines))


# --- what is asked of types, and terms ------------------------------------------------


def _answer_term(session: Session, claim: trees.Term, reader: Reader) -> Reply:
    match claim:
        case Application(_, _, Name(_, _, (word,), None)) if (
            word in ASKED and word not in session.theory.names
        ):
            return _answer_about_types(session, word, claim, reader)
        case Name(_, _, (name,), None) if _is_rule_or_game(session, name):
            return Reply(session, _declaration_of(session, name))
        case Application(_, _, Name(_, _, (name,), None)) if (
            name in session.theory.rules
        ):
            rule, args = CheckReader(reader).step(claim, name)
            args = tuple(map(session.model.reduce, args))
            return _show(session, apply_rule(rule, args, session.model).state)
        case Application(_, _, Name(_, _, (name,), None), args) if (
            name in session.theory.openings
        ):
            return _play_game(session, name, [reader.object(arg, ()) for arg in args])
    value = session.model.reduce(reader.object(claim, ()))
    return _show(session, normal_value(value, session.theory))


def _show(session: Session, value: LastAnswer) -> Reply:
    text = notation(value, session.theory.spelling)
    return Reply(replace(session, last=value), text)


def _is_rule_or_game(session: Session, name: str) -> bool:
    theory = session.theory
    played = (theory.rules, theory.strategies, theory.openings)
    return any(name in kind for kind in played)


def _declaration_of(session: Session, name: str) -> str:
    """The declaration of a rule, strategy or game; defined types by name."""
    return declaration(session.theory, name, abbreviator(session.theory, 0))


def _play_game(session: Session, name: str, events: list[Object]) -> Reply:
    """The turns of a game from its start: one for each event, or one empty turn."""
    game = session.theory.games[name]
    turns = game.play([session.model.reduce(event) for event in events] or [None])
    state = notation(turns[-1].state)
    return Reply(session, "\n".join([*map(str, turns), f"state: {state}"]))


def _answer_about_types(
    session: Session, word: str, claim: Application, reader: Reader
) -> Reply:
    wanted = 2 if word in _MERGES else 1
    if len(claim.args) != wanted:
        needed = "one type" if wanted == 1 else "two types"
        reader.refuse(claim, f"{word} takes {needed}, but has {len(claim.args)}")
    if word == "wellformed":
        place = claim.start, claim.end
        question = trees.Question(*place, "yes", trees.Claim(*place, claim))
        return _answer_check(session, CheckReader(reader).check(question))
    types = [_reduced_type(session, reader.type(arg, ())) for arg in claim.args]
    match word, types:
        case "create", [T]:
            return _create(session, T)
        case "P", [T]:
            return Reply(session, str(session.model.true(T)))
        case "witnesses", [T]:
            known = session.model.witnesses(T)
            listed = "\n".join(map(notation, known)) or "none is known"
            return Reply(replace(session, last=known), listed)
    S, T = types
    return _show(session, _MERGES[word](S, T, session.theory))


def _create(session: Session, T: TypeNode) -> Reply:
    after, witness = create_witness(session, T)
    last = after.model.judge(witness, T)
    return Reply(replace(after, last=last, before=session), notation(witness))
