"""Format turns, judgements and things in view for people."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from kille.agent.attention import NumberedLook
from kille.agent.exchanges import Exchange
from kille.dialogue.meanings import predicate_at
from kille.interfaces.terminal import hanging_type
from ttr import Rec, Record, RecordType, record, rectype
from ttr.judging import Judgement
from ttr.types import PType, Singleton
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.types.substitution import resolve_paths
from ttr.updates import Step

Account = Callable[[Exchange], Iterable[tuple[str, str]]]
"""An account of a turn beside its words: lines, each with its kind."""

_TOLD_APART = ("shared.latest", "private.beliefs")


def show_nothing(turn: Exchange) -> Iterator[tuple[str, str]]:
    """Give no account at all."""
    yield from ()


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


def format_account(account: Iterable[tuple[str, str]]) -> Iterator[str]:
    """Format an account as lines, in a column beside the dialogue."""
    for kind, text in account:
        yield hanging_type(f"     {kind:>6}  ", text)


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


def things_in_view(view: NumberedLook) -> str:
    """The numbered things, the place of each, and which one is in focus."""
    percepts = view.look.percepts
    if not percepts:
        return "Nothing is in view."
    count = "One thing is" if len(percepts) == 1 else f"{len(percepts)} things are"
    lines = [f"{count} in view:"]
    for number, percept in enumerate(percepts, start=1):
        mark = "  ← this" if number == view.focus else ""
        lines.append(f"  #{number}  {_where(percept.region.place)}{mark}")
    return "\n".join(lines)


def _where(place: tuple[float, float, float] | None) -> str:
    if place is None:
        return "place unknown"
    right, _, away = place
    side = "right" if right >= 0 else "left"
    if abs(right) < 0.02:
        return f"{away:.2f} m away, straight ahead"
    return f"{away:.2f} m away, {abs(right) * 100:.0f} cm to the {side}"
