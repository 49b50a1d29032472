"""What the page asks of `ttr`, and the answers as values that JSON can carry.

The page's worker imports this module. All that is HTML in an answer was escaped by
`ttr.display`; all else is text, and the page shows it as text.
"""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterable
from contextlib import redirect_stderr, redirect_stdout
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from ttr.cli.main import main
from ttr.display.html import STYLE
from ttr.display.render import html
from ttr.errors import MistakesError, Span, TTRError
from ttr.judging.models import model_of
from ttr.safety.budgets import STEPS, budget
from ttr.theories.checking import answers, check
from ttr.theories.theory import Theory, theory_of_text
from ttr.types.printing import notation
from ttr.types.syntax import Pred, TypeNode
from ttr.updates.games import Game, Turn, format_event
from ttr.updates.running import Run
from ttr.updates.update_strategies import event_types

FILE = "theory.ttr"
"""What the text in the editor is called in messages."""

MOST = 200
"""How many mistakes, definitions or answers are shown."""

OFFERS = 40
"""How many moves are offered."""

DIALOGUES = 2000
"""How many dialogues a test may play."""

Facts = dict[str, Any]
_T = TypeVar("_T")


class Playground:
    """The theory in the editor, and the dialogue that is being played with it."""

    def __init__(self) -> None:
        self._theory: Theory | None = None
        self._game: Game | None = None
        self._turns: list[Turn] = []
        self._offers: tuple[TypeNode | None, ...] = ()

    def respond(self, request: str) -> str:
        """The answer to a request, in JSON; what is wrong is part of it."""
        asked = json.loads(request)
        todo: dict[str, Callable[[Facts], Facts]] = {
            "check": lambda it: self.check(it["text"]),
            "play": lambda it: self.play(it["game"]),
            "move": lambda it: self.move(it["move"]),
            "back": lambda it: self.back(),
            "test": lambda it: self.test(it["game"], it["seed"], it["examples"]),
            "command": lambda it: command_output(it["file"], it["text"]),
        }
        try:
            answer = todo[asked["do"]](asked)
        except TTRError as error:
            answer = {"error": str(error)}
        except RecursionError:
            answer = {"error": "types are nested too deep to be shown or checked"}
        return json.dumps(answer)

    def check(self, text: str) -> Facts:
        """Read a theory: its mistakes, or definitions, answers and faults."""
        self._theory, self._game, self._turns = None, None, []
        try:
            with budget(steps=STEPS):
                theory = theory_of_text(text, FILE)
                report = check(theory)
                answered = answers(theory, model_of(theory))
        except MistakesError as error:
            return _mistakes(error.errors)
        except TTRError as error:
            return _mistakes((error,))
        self._theory = theory
        return {
            "mistakes": [],
            "summary": report.summary,
            "holds": report.holds,
            "definitions": [
                _definition(theory, it) for it in _some(theory.definitions)
            ],
            "more": max(0, len(theory.definitions) - MOST),
            "answers": [
                {
                    **_place(asked.span),
                    "text": asked.text,
                    "holds": answer.verdict == asked.expected,
                    "expected": asked.expected,
                    "found": answer.found,
                    "why": "" if answer.derivation else answer.why,
                    "html": _html(answer.derivation, theory)
                    if answer.derivation
                    else "",
                }
                for asked, answer in _some(answered)
            ],
            "faults": [
                {
                    **_place(one.span),
                    "severity": one.severity,
                    "message": one.message,
                    "help": one.hint,
                }
                for one in _some(report.faults)
            ],
            "games": list(theory.openings),
        }

    # --- playing ---

    def play(self, name: str) -> Facts:
        """Begin a dialogue with a game of the theory."""
        self._game, self._turns = self._game_of(name), []
        return self._position()

    def move(self, number: int) -> Facts:
        """Make the offered move of this number."""
        if self._game is None or not 0 <= number < len(self._offers):
            raise TTRError("no such move is offered: choose a game first")
        self._turns.append(self._game.take(self._run(), self._offers[number]))
        return self._position()

    def back(self) -> Facts:
        """Take the last turn back."""
        del self._turns[-1:]
        return self._position()

    def test(self, name: str, seed: int, examples: int) -> Facts:
        """Play drawn dialogues, and show the shortest that breaks a property."""
        from ttr.dialogues.settings import Setting
        from ttr.testing import Suite

        game = self._game_of(name)
        count = max(1, min(examples, DIALOGUES))
        report = Suite(game, examples=count, seed=seed).run()
        place = Setting.of(game, self._theory, f"{FILE} {name}")
        played = report.coverage.dialogues
        dialogues = f"{played} dialogue{'s' * (played != 1)}"
        return {
            "holds": report.holds,
            "summary": f"{name}: {'holds' if report.holds else 'breaks'}, {dialogues}",
            "story": report.explain_failure(place),
            "coverage": report.coverage.table(),
        }

    def _game_of(self, name: str) -> Game:
        if self._theory is None or name not in self._theory.games:
            raise TTRError(f"the theory has no game {name}: check it first")
        return self._theory.games[name]

    def _run(self) -> Run:
        assert self._game is not None
        return self._turns[-1].run if self._turns else self._game.begin()

    def _position(self) -> Facts:
        game, theory = self._game, self._theory
        if game is None or theory is None:
            raise TTRError("no game is being played: choose one first")
        run = self._run()
        kinds = (None, *islice(game.hears or event_types(game.rules), OFFERS))
        self._offers = tuple(one for one in kinds if _is_taken(game, run, one))
        return {
            "game": game.name,
            "state": _html(run.state, theory),
            "turns": [_turn(one, theory) for one in self._turns],
            "offers": [
                "nothing happens" if one is None else _name_of(one, theory)
                for one in self._offers
            ],
        }


def command_output(file: str, text: str) -> Facts:
    """What `ttr check` prints about a file with this text, and its exit code."""
    path = Path(file)
    path.write_text(text, encoding="utf-8")
    out = io.StringIO()
    with redirect_stdout(out), redirect_stderr(out):
        code = main(["check", path.name])
    return {"code": code, "output": out.getvalue()}


def _mistakes(errors: Iterable[TTRError]) -> Facts:
    every = tuple(errors)
    count = len(every)
    return {
        "mistakes": [
            {
                **_place(one.span),
                "message": one.message,
                "help": one.hint,
                "text": str(one),
            }
            for one in _some(every)
        ],
        "summary": f"{count} mistake{'s' * (count != 1)}, nothing checked",
        "holds": False,
        "games": [],
    }


def _place(span: Span | None) -> Facts:
    if span is None or span.source != FILE:
        return {}
    return {"line": span.line, "column": span.column, "length": span.length}


def _definition(theory: Theory, name: str) -> Facts:
    value = theory.definitions[name]
    if isinstance(value, Pred):
        return {"name": name, "html": "", "text": notation(value)}
    return {"name": name, "html": _html(value, theory), "text": ""}


def _html(value: object, theory: Theory) -> str:
    """The value as HTML without its style, which the page has; empty if too deep."""
    try:
        return html(value, theory=theory).replace(f"<style>{STYLE}</style>", "")
    except TTRError:
        return ""


def _some(values: Iterable[_T]) -> list[_T]:
    return list(islice(values, MOST))


def _is_taken(game: Game, run: Run, event: TypeNode | None) -> bool:
    """Does a rule fire when this happens? Also where it goes wrong: that is shown."""
    try:
        return bool(game.take(run, event).trace)
    except TTRError:
        return True


def _name_of(value: TypeNode, theory: Theory) -> str:
    known = (name for name, one in theory.definitions.items() if one is value)
    return next(known, notation(value))


def _turn(turn: Turn, theory: Theory) -> Facts:
    return {
        "heard": "nothing" if turn.heard is None else format_event(turn.heard),
        "steps": [
            {
                "rule": str(step.rule),
                "changes": list(step.changes),
                "state": _html(step.after, theory),
            }
            for step in turn.trace
        ],
        "said": [f"{notation(one.sit)} : {one.type}" for one in turn.said],
    }
