"""Format turns, judgements and things in view for people."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from kille.agent.agent import Agent
from kille.agent.attention import NumberedLook
from kille.agent.exchanges import Exchange
from kille.dialogue.meanings import CLAIMS, predicate_at
from kille.interfaces.terminal import cut_line, hanging_type
from kille.perception.shown_looks import place_in_words
from ttr import Rec, Record, RecordType, meet, record, rectype
from ttr.judging import Judgement
from ttr.types import PType, Singleton, TypeNode
from ttr.types.objects import Object, UnresolvedError
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import as_type
from ttr.updates import Step

Account = Callable[[Exchange], Iterable[str]]
"""An account of a turn beside its words, line by line."""

_LEFT_OUT = (
    "shared.latest", "shared.here", "private.agenda", "private.beliefs",
    "private.cost", "private.last", "view.look", "shared.noticed", "shared.sights",
)  # fmt: skip
"""What a summary says otherwise, or changes in every turn."""

_TOLD_APART = ("shared.latest", "private.beliefs")


def claims(turn: Exchange) -> Iterator[tuple[str, str]]:
    """The judgements behind a turn: what was heard, judged of things, and said."""
    if turn.heard is not None:
        yield from _move("heard", turn.heard)
    yield from _moves_as_lines(turn)


def derivation(turn: Exchange) -> Iterator[tuple[str, str]]:
    """A turn in full: the judgement that the parse is, each rule and its changes."""
    if turn.heard is not None:
        yield from _move("heard", turn.heard)
        for sign in turn.heard.sit.signs:
            yield "word", f'"{sign.form}", {sign.kind} : {notation(sign.meaning)}'
    for step in turn.steps:
        doc = step.rule.doc.split("\n")[0]
        yield "rule", f"{step.rule.name}: {doc}"
        for change in _changes(step):
            yield "", change
    yield from _moves_as_lines(turn)


def summary(turn: Exchange) -> Iterator[tuple[str, str]]:
    """A turn in at most ten lines: what was heard, which rules ran, what they changed.

    Why is what the rules that planned an answer are for. Contents are their claims.
    """
    if turn.heard is not None:
        yield "heard", _move_in_brief(turn.heard)
    if turn.steps:
        yield "rules", ", ".join(step.rule.name for step in turn.steps)
        yield from _first_few("why", _reasons(turn.steps), 2)
        start, end = turn.steps[0].before, turn.steps[-1].after
        changes = differences(_with_claims(start), _with_claims(end))
        kept = [it for it in changes if not it.startswith(_LEFT_OUT)]
        yield from _first_few("new", kept, 3)
    yield from _first_few("judged", map(_belief, _beliefs(turn)), 2)
    moves = [it.judgement for it in turn.said if it.judgement is not None]
    if moves:
        yield "said", "; ".join(map(_move_in_brief, moves))


def _first_few(kind: str, texts: Iterable[str], most: int) -> Iterator[tuple[str, str]]:
    """So many lines at most; if there are more texts, the last line says how many."""
    every = list(texts)
    shown = every if len(every) <= most else every[: most - 1]
    yield from ((kind, text) for text in shown)
    if more := len(every) - len(shown):
        yield "", f"… and {more} more; @ trace shows all"


def _reasons(steps: Iterable[Step]) -> Iterator[str]:
    """What the rules are for that planned an answer."""
    for step in steps:
        if len(step.after.private.agenda) > len(step.before.private.agenda):
            yield f"{step.rule.name}: {step.rule.doc.split(chr(10))[0]}"


def _with_claims(value: Object) -> Object:
    """A state as in short, with the claims of contents in place of these."""
    match in_short(value):
        case Record() as short:
            return record({label: _with_claims(short[label]) for label in short})
        case tuple() as several:
            return tuple(map(_with_claims, several))
        case RecordType() as content if content.fields:
            return _claim(content)
        case short:
            return short


def _claim(content: RecordType) -> TypeNode:
    """What a content says of things that are known, else the content itself."""
    around = (_values(content),)
    claims_ = [content[label] for label in CLAIMS if label in content]
    try:
        found = [as_type(resolve_paths(it, around)) for it in claims_]
    except UnresolvedError:
        return content
    return meet(*found) if found else content


def _values(T: RecordType) -> dict[str, Object]:
    """The values that a content gives its fields, those inside others included."""
    found: dict[str, Object] = {}
    for label, field in T.fields:
        if isinstance(field, RecordType):
            found[label] = record(_values(field))
        elif isinstance(field, Singleton) and not free_paths(field.value):
            found[label] = field.value
    return found


def _move_in_brief(judgement: Judgement) -> str:
    """A move as a judgement, and its claim or the thing that it is about."""
    move = next((text for _, text in _move("", judgement)), "")
    content: RecordType = judgement.sit.content
    claim = _claim(content)
    if claim is not content:
        return f"{move}, that {notation(claim)}"
    x = _values(content).get("target")
    return f"{move}, of {x.x}" if isinstance(x, Record) and "x" in x else move


def format_account(account: Iterable[tuple[str, str]]) -> Iterator[str]:
    """Format an account as lines, in a column beside the dialogue."""
    for kind, text in account:
        yield hanging_type(f"     {kind:>6}  ", text)


def whole_account(turn: Exchange) -> Iterator[str]:
    """A turn in full, in a column beside the dialogue."""
    return format_account(derivation(turn))


def short_account(turn: Exchange) -> Iterator[str]:
    """A turn in at most ten lines, each cut off where the terminal ends."""
    for kind, text in summary(turn):
        yield cut_line(f"     {kind:>6}  ", text)


ACCOUNTS: Mapping[str, Account] = {
    "none": lambda _: (),
    "short": short_account,
    "whole": whole_account,
}


def _moves_as_lines(turn: Exchange) -> Iterator[tuple[str, str]]:
    for belief in _beliefs(turn)[:3]:
        yield "judged", _belief(belief)
    for said in turn.said:
        if said.judgement is not None:
            yield from _move("said", said.judgement)


def _changes(step: Step) -> Iterator[str]:
    """The changes made by a rule, without moves and beliefs, which have their own
    lines.

    What leaves a list is not repeated: it was shown when it came on.
    """
    for change in differences(in_short(step.before), in_short(step.after)):
        path, taken_off, _ = change.partition(": − ")
        if not path.startswith(_TOLD_APART):
            yield f"{path}: − …" if taken_off else change


def in_short(value: Object) -> Object:
    """Shorten a state for people: a word to its form, a planned move to what it will
    say.

    What the words mean was shown when they were heard.
    """
    match value:
        case Record() if "meaning" in value and "form" in value:
            return value.form
        case Record():
            return record({label: in_short(value[label]) for label in value})
        case tuple():
            return tuple(map(in_short, value))
        case RecordType() if "teaches" in value and "signs" in value:
            return _planned_move(value)
    return value


def _planned_move(T: RecordType) -> RecordType:
    """A planned move without its empty fields and those still to be filled."""
    told = {
        label: Singleton(field.base, in_short(field.value))
        for label, field in T.fields
        if isinstance(field, Singleton) and field.value not in ((), Rec)
    }
    return rectype({"e": T["e"], **told})


def _move(who: str, judgement: Judgement) -> Iterator[tuple[str, str]]:
    """A move as a judgement, e : act(speaker, addressee), and what it is about."""
    move, T = judgement.sit, judgement.type
    if not isinstance(T, RecordType):
        return
    yield who, f"{move.e} : {predicate_at(T, 'e').name}({move.spkr}, {move.addr})"
    if move.content.fields:
        yield "about", notation(move.content)


def _beliefs(turn: Exchange) -> tuple[Record, ...]:
    """The beliefs that the robot formed in this turn, the most probable first."""
    if not turn.steps:
        return ()
    beliefs: tuple[Record, ...] = turn.steps[-1].after.private.beliefs
    return beliefs


def _belief(belief: Record) -> str:
    """A belief as a judgement: that something makes the word's ptype true."""
    sit = belief.sit
    for _, field in belief.sign.meaning.fields:
        if isinstance(field, PType):
            return f"some : {resolve_paths(field, (sit,))}   p = {belief.p:.2f}"
    return f"{sit} : {belief.sign.meaning}   p = {belief.p:.2f}"


def introduction(robot: Agent) -> str:
    """What it looks through, how many nouns it knows, and where they are kept."""
    known = len(robot.state.private.nouns)
    return (
        f"I look through {robot.gaze.sensor.name} and know {known or 'no'} "
        f"word{'s' * (known != 1)} for things; they are kept in {robot.memory.place}."
    )


def things_in_view(view: NumberedLook) -> str:
    """The numbered things, the place of each, and which are "this" and "that"."""
    percepts = view.look.percepts
    if not percepts:
        return "Nothing is in view."
    count = "One thing is" if len(percepts) == 1 else f"{len(percepts)} things are"
    lines = [f"{count} in view:"]
    for number, percept in enumerate(percepts, start=1):
        role = view.roles.get(number)
        mark = f"  ← {role}" if role else ""
        lines.append(f"  #{number}  {place_in_words(percept.region.place)}{mark}")
    return "\n".join(lines)
