"""Nobody speaks: the robot remarks on what has come, gone or moved, or asks something.

Its strategy says after how many seconds of silence, in which nothing moves either; by
default never. It takes no turn while the tutor keeps the floor, while a question of its
own is open, and never to say again what it has said.

Source: Skantze, Hjalmarsson and Oertel 2014; Kelleher, Costello and van Genabith 2005.
"""

from __future__ import annotations

from collections.abc import Iterator

from kille.dialogue.beliefs import is_sure, knows, names_of, thinks
from kille.dialogue.games.listening import state_after_look
from kille.dialogue.games.taking_initiative import (
    ask_most_wanted,
    is_told,
    question,
    turn_to,
)
from kille.dialogue.meanings import DialogueTypes, set_at, set_to
from kille.dialogue.moves import number_field, plan, said_of
from kille.dialogue.rules import rule
from ttr import Model, Record, record, replace
from ttr.updates import first, maybe, seq

NEW, GONE, MOVED = "new", "gone", "moved"
"""What may have become of a thing."""


@rule(when="State", on="Watched")
def watch(s: Record, seen: Record, *, model: Model) -> Record:
    """What is in view is what the latest look shows, and what has changed is news."""
    after = state_after_look(s, seen)
    known = [it for it in s.private.news if it.what != NEW or it.x in seen.kept]
    return replace(after, {"private.news": (*known, *_changes(s, after, seen, model))})


@rule(when="FreeFloor", on="Watched")
def remark(
    s: Record, seen: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """Something has come, gone or moved, and nobody says anything: it does."""
    patience = s.private.strategy.turns.remark
    if s.shared.qud or not 0.0 < patience <= min(seen.silence, seen.still):
        return None
    return remark_on_news(s, model, types=types)


@rule(when="FreeFloor", on="Watched")
def ask_in_silence(
    s: Record, seen: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """Nobody says anything: it asks for what it would like to know most."""
    turns = s.private.strategy.turns
    if s.shared.qud or not 0.0 < turns.ask <= seen.silence:
        return None
    last = s.private.last
    if seen.still < turns.remark or (last and last[-1] <= types["Questioning"]):
        return None
    return ask_most_wanted(s, model, types=types)


def remark_on_news(s: Record, model: Model, *, types: DialogueTypes) -> Record | None:
    """The state in which it remarks on the first of its news that still is one."""
    for number, news in enumerate(s.private.news, start=1):
        planned = _plan_remark(s, news, model, types=types)
        if planned is not None:
            return replace(planned, {"private.news": s.private.news[number:]})
    return None


def _plan_remark(
    s: Record, news: Record, model: Model, *, types: DialogueTypes
) -> Record | None:
    """The plan to say what has become of a thing, unless it has been talked about."""
    if news.what != NEW:
        act = "TellGone" if news.what == GONE else "TellMoved"
        if not news.signs:
            return plan(s, act, types=types)
        return plan(s, act, news.signs[0].meaning, signs=news.signs, types=types)
    x = news.x
    asked = question("AskThing", things=(x,))
    if is_told(s, x) or asked in s.private.asked:
        return None
    beliefs = names_of(s, model, x)
    number = number_field(s, x, types=types) if len(s.view.things) > 1 else {}
    if thinks(s, beliefs):
        sign = beliefs[0].sign
        claim = said_of(s, sign, x, types=types)
        planned = plan(
            s,
            "AskNewName",
            set_to(claim, **number),
            signs=[sign],
            pending=[claim],
            points=[x],
            types=types,
        )
    else:
        content = set_at(types.record_type("Asked"), "look", s.view.look)
        content = set_to(set_at(content, "target.x", x), **number)
        planned = plan(s, "AskNew", content, points=[x], types=types)
    done = {"private.asked": (*s.private.asked, asked)}
    return replace(turn_to(planned, x), done)


def _changes(s: Record, after: Record, seen: Record, model: Model) -> Iterator[Record]:
    """What has come, gone and moved: what went by a noun and came by the same moved."""
    gone = {x: _noun(s, model, x) for x in seen.went}
    for x in seen.came:
        noun = _noun(after, model, x) if gone else ()
        again = next((y for y in gone if noun and knows(gone[y], noun[0])), None)
        if again is None:
            yield record(what=NEW, x=x, signs=())
        else:
            del gone[again]
            yield record(what=MOVED, x=x, signs=noun)
    for x, noun in gone.items():
        yield record(what=GONE, x=x, signs=noun)


def _noun(s: Record, model: Model, x: str) -> tuple[Record, ...]:
    """The noun that it is sure a thing is called by, if there is one."""
    beliefs = names_of(s, model, x)
    return (beliefs[0].sign,) if is_sure(s, beliefs) else ()


BREAKING_SILENCE = seq(watch, maybe(first(remark, ask_in_silence)))
