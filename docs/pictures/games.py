"""Writes docs/reference/games.md: every game as a table, played as it is now.

Each table is a dialogue with the simulated robot of `kille.lab.worlds`: what is said,
the rules that answer it, and what they change in the state. Run from the top folder:

    python docs/pictures/games.py
"""

from __future__ import annotations

import inspect
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from kille.interfaces.formatting import in_short
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.perception import look_event, view
from kille.lab.worlds.worlds import Thing, World
from ttr import Record, record, replace
from ttr.types.records import differences
from ttr.updates import Game, Run, Turn

DIALOGUES = Path(__file__).with_suffix(".toml")
PAGE = Path(__file__).parents[1] / "reference" / "games.md"

HEAD = """\
# Games of tutoring

Every game as a dialogue with the simulated robot: what is said, the rules that answer
it, and what they change in the state. A game is a page of `kille/dialogue/games/`; the
types of its moves are in `grammars/tutor.ttr`, its sentences in
`grammars/tutor.en.lark` and `lexicon.en.toml`. This page is written by
`python docs/pictures/games.py`.
"""

ALWAYS = {"hear", "refer", "say", "see", "glance"}
"""The rules of every turn, which the page on listening tells of."""

UNSAID = (
    "private.agenda",
    "private.beliefs",
    "private.cost",
    "private.last",
    "shared.latest",
    "shared.here",
    "shared.noticed",
    "shared.sights",
    "view",
)
"""What changes in every turn."""


def page() -> str:
    """The page, of games as they are played now."""
    games = tomllib.loads(DIALOGUES.read_text(encoding="utf-8"))["game"]
    return "\n".join([HEAD, *(line for it in games for line in _section(it))]) + "\n"


def _section(game: Mapping[str, Any]) -> Iterator[str]:
    module = import_module(f"kille.dialogue.games.{game['page']}")
    doc = (inspect.getdoc(module) or "").split("\n\n")[0].replace("\n", " ")
    yield f"## {game['title']}\n"
    yield f"{doc} `kille/dialogue/games/{game['page']}.py`\n"
    yield "| said | rules | state before → after |"
    yield "| --- | --- | --- |"
    world = World(tuple(Thing(**_placed(it)) for it in game.get("things", ())))
    known = _taught_earlier(world, game.get("earlier", ()))
    playing = simulated_game(world, turns=game.get("turns", ""), **known)
    now, turn = playing.begin(), None
    for text in game["dialogue"]:
        if turn is not None and text.startswith("@ interrupt"):
            event: object = _interruption(turn, text.removeprefix("@ interrupt "))
        else:
            world, event = _happening(playing, world, text)
        turn = playing.take(now, event)
        yield _row(playing, now, turn, text)
        now = turn.run
    yield ""


def _taught_earlier(world: World, texts: Sequence[str]) -> dict[str, Any]:
    """What a robot knows to which this was said in another dialogue."""
    if not texts:
        return {}
    playing = simulated_game(world)
    now = playing.begin()
    for text in texts:
        assert playing.hear is not None
        now = playing.take(now, playing.hear(text)).run
    private = now.state.private
    return {
        "signs": list(private.nouns),
        "kinds": [replace(it, after=-1.0) for it in private.kinds],
        "criteria": [replace(it, after=-1.0) for it in private.criteria],
    }


def _happening(game: Game, world: World, text: str) -> tuple[World, object]:
    """What a line makes happen: words, or a change of the scene that is then seen."""
    match text.split():
        case ["@", "put", number, right, away]:
            after = world.move(int(number), (int(right), int(away)))
        case ["@", "take", number]:
            after = world.move(int(number), None)
        case ["@", "point", number]:
            after = world.point_at(int(number))
        case ["@", "meanwhile", "take", number]:
            after = world.move(int(number), None).look_again()
            return after, _watching_event(after, world)
        case ["@", "meanwhile", "put", number, right, away]:
            after = world.move(int(number), (int(right), int(away))).look_again()
            return after, _watching_event(after, world)
        case _:
            assert game.hear is not None
            return world, game.hear(text)
    after = after.look_again()
    return after, look_event(after, world)


def _watching_event(after: World, before: World) -> Record:
    """The event of seeing that something has come or gone, after two seconds."""
    seen, then = view(after), view(before)
    came = [x for x in seen.things if x not in then.things]
    went = [x for x in then.things if x not in seen.things]
    kept = [x for x in seen.things if x not in came]
    return record(view=seen, kept=kept, came=came, went=went, silence=2.0, still=2.0)


def _interruption(turn: Turn, uttered: str) -> Record:
    """The event of cutting off the first sentence of a turn."""
    moves = [it.type for it in turn.said]
    return record(unsaid=moves, uttered=uttered, latest=turn.said[0].sit)


def _placed(thing: Mapping[str, Any]) -> dict[str, Any]:
    return {**thing, "place": tuple(thing["place"])}


def _row(game: Game, before: Run, turn: Turn, text: str) -> str:
    assert game.say is not None
    said = [text if text.startswith("@") else f"U: {text}"]
    said += [f"S: {sentence}" for it in turn.said for sentence in [game.say(it)]]
    rules = dict.fromkeys(
        f"`{step.rule.name}` {step.rule.doc.splitlines()[0]}"
        for step in turn.trace
        if step.rule.name not in ALWAYS
    )
    changes = [f"`{_short(it)}`" for it in _changes(before.state, turn.state)]
    cells = (said, rules, changes)
    return "| " + " | ".join("<br>".join(map(_cell, it)) for it in cells) + " |"


def _changes(before: Record, after: Record) -> Iterator[str]:
    for change in differences(in_short(before), in_short(after)):
        if not change.startswith(UNSAID):
            yield change


def _short(change: str) -> str:
    """A change in little room: a look without the world that it is at."""
    change = re.sub(r'"(look\d+) of [^"]*"', r"\1", change)
    return change if len(change) <= 130 else f"{change[:129]}…"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
