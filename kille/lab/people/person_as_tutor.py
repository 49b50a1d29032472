"""A person at the keyboard who is the tutor: what there is is shown, and they type."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from kille.lab.errors import StudyError
from kille.lab.people.instructions import (
    example,
    format_view,
    instruction,
    kept_kind,
    question,
)
from kille.lab.people.typed_lines import Ask, read_line
from kille.lab.people.typed_sayings import QUESTIONS, acts, claimed_words
from kille.lab.robots.replies import Reply
from kille.lab.scenes.scene import Occasion
from kille.lab.scenes.table_commands import occasion_after
from kille.lab.tutors.tutor import (
    Asked,
    Happens,
    Move,
    Says,
    Shows,
    Task,
    Turns,
    Waits,
)
from kille.lab.tutors.words import Words
from kille.sensors.sensor import SensorError

ON, HELP = ".", "?"

_LANGUAGES = {"en": "English", "sv": "Swedish"}
_HELP = """\
You are the tutor: type what you say to the robot, in {language}, and press Enter.
  .              go on to the next step
  Enter alone    let the robot look once more, and say something if it likes{table}
  @ restart      let another day begin: the robot knows what it was taught
  ?              read this again; "{help}" asks the robot what it understands
  Ctrl-C         stop: dialogues that are over are kept, this one begins anew"""
_TABLE = """
  @ point 2      point at #2
  @ place 2 3 4  put #2 3 right, 4 away: steps of 10 cm, as the robot sees it
  @ remove 2     take #2 away"""
_HINT = "(. to go on, ? for help)"
_UNASKED = 'No answer is kept yet: ask, such as "{}", or type . once more to go on.'
_RIGHT = """\
Before it answers, what is right? Say so, such as "{}"
(type nothing, and the answer is not counted)."""
_UNREAD = 'No word for a place is read in that: say it as "{}", or type nothing.'

_CORRECTING = ("correct", "deny", "reject")
"""The moves that set the robot right, if it has claimed something."""


@dataclass(frozen=True)
class Keyboard:
    """A person who types in the robot's language.

    In phases that ask, the first question for what the step is about is the one of
    which the answer is kept.
    """

    name: str
    language: str = "en"
    ask: Ask = read_line

    def turns(self, task: Task) -> Turns:
        """The moves that the person types until they go on."""
        return _Step(self, task).turns()


class _Step:
    """A task as a person does it: what is before them, and what was said last."""

    def __init__(self, who: Keyboard, task: Task) -> None:
        self._who, self._task = who, task
        self._now = task.of
        if self._now is not None and task.do == "find":
            self._now = self._now.without_pointing()
        self._last: Reply | None = None
        self._owes = bool(kept_kind(task))
        self._reminded = False

    def turns(self) -> Turns:
        """The moves that the person types until they go on."""
        task = self._task
        told = f"\nStep {task.number}, {task.phase}: {instruction(task)}."
        if self._now is not None:
            told += f"\n{yield from self._make_move(Shows(self._now))}"
        told += f"\n{self._help() if self._task.number == 1 else _HINT}"
        line = self._line(told)
        while line != ON or self._is_owing():
            line = self._line((yield from self._respond(line)))

    def _line(self, told: str) -> str:
        return self._who.ask(f"{told}\n{self._who.name} (you): ").strip()

    def _help(self) -> str:
        has_table = self._now is not None and self._now.view is None
        return _HELP.format(
            language=_LANGUAGES[self._who.language],
            help=Words(self._who.language).plain_move("ask_help"),
            table=_TABLE if has_table else "",
        )

    def _is_owing(self) -> bool:
        """Whether the person has yet to ask, and was not told so."""
        owes, self._reminded = self._owes and not self._reminded, True
        return owes

    # --- what comes of a line --------------------------------------------------------

    def _respond(self, line: str) -> Generator[Move, Reply, str]:
        """What the person is shown after a line: the robot's reply, or an error."""
        if line == HELP:
            return self._help()
        if line == ON:
            return _UNASKED.format(question(self._task, self._who.language))
        try:
            move = self._move(line)
            return (yield from self._make_move(move))
        except (StudyError, SensorError) as error:
            return str(error)

    def _make_move(self, move: Move) -> Generator[Move, Reply, str]:
        reply = yield move
        self._last = reply
        said = f"Robot: {reply.text}" if reply.text else ""
        match move:
            case Shows(now):
                self._now = now
                return f"{format_view(now, now.world)}\n{said}".rstrip()
            case Waits(now):
                self._now = now
            case Happens():
                return f"Another day begins.\n{said}".rstrip()
        return said or "(The robot says nothing.)"

    def _move(self, line: str) -> Move:
        """The move that a line is; `StudyError` where it is none."""
        if line.startswith("@"):
            return self._command_move(line.removeprefix("@").strip())
        if not line:
            return self._wait()
        moves = acts(line, self._who.language)
        act = moves[0] if moves else "says"
        return Says(line, act, self._question_asked(moves), self._corrects(act))

    def _wait(self) -> Move:
        if self._now is None:
            raise StudyError(["There is nothing to look at: type what you say."])
        return Waits(self._now.look_again())

    def _command_move(self, command: str) -> Move:
        if command == "restart":
            return Happens(command)
        if command == "look":
            return self._wait()
        if self._now is None or self._now.view is not None:
            told = "write `look` or `restart`, nothing else can happen here"
            raise StudyError([f"@ {command or '…'}: {told}"])
        return Shows(occasion_after(self._now, command))

    # --- what is kept of it ----------------------------------------------------------

    def _corrects(self, act: str) -> bool:
        """Whether a move corrects the robot, which may have asked, though."""
        last = self._last
        return (
            act in _CORRECTING
            and last is not None
            and bool(last.text)
            and not last.asks
        )

    def _question_asked(self, moves: tuple[str, ...]) -> Asked | None:
        """The question of this step, if this move asks it."""
        kind, now = kept_kind(self._task), self._now
        asks = kind in {QUESTIONS.get(it) for it in moves}
        if not self._owes or not asks or now is None:
            return None
        x = now.x if kind == "reference" else now.world.attended_thing
        if x is None or (kind == "relation" and x != now.x):
            return None
        right = self._right(kind, now, x)
        self._owes = False
        y = now.y if kind == "relation" else None
        return Asked(kind, right, x, y, frozenset({right})) if right else None

    def _right(self, kind: str, now: Occasion, x: int) -> str:
        """What the person holds to be right; nothing if they do not say."""
        words, thing = Words(self._who.language), now.world.thing(x)
        match kind:
            case "reference":
                return now.name(x)
            case "noun":
                return words.word_for(thing.kind)
            case "adjective":
                return words.word_for(thing.colour)
        return words.word_for(now.said) if now.said else self._place()

    def _place(self) -> str:
        """The word for a place that they would use themselves."""
        language = self._who.language
        so = example("relation", language)
        line = self._who.ask(f"{_RIGHT.format(so)}\nright: ").strip()
        while line:
            found = dict(claimed_words(line, language)).get("relation")
            if found:
                return found
            line = self._who.ask(f"{_UNREAD.format(so)}\nright: ").strip()
        return ""
