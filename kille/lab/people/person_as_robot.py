"""A person who plays the robot: who is shown what it sees, hears the tutor, and types.

What they claim in a sentence counts as their answer; whatever else they say counts as
not knowing. They point at things by their numbers.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from kille.dialogue.language import Utterance
from kille.dialogue.state import blank_model, initial
from kille.lab.people.instructions import example, format_view
from kille.lab.people.typed_lines import Ask, read_line
from kille.lab.people.typed_sayings import acts, asked_kind, claimed_words, sentences
from kille.lab.robots.replies import Reply
from kille.lab.scenes.scene import Occasion
from kille.lab.scenes.table_commands import occasion_after
from ttr import Model, record
from ttr.judging import Judgement
from ttr.probability import CERTAIN

_HELP = """\
You are the robot: type what you say to the tutor, and press Enter.
  .           say nothing, as Enter alone does
  #2          point at #2
  ?           read this again
  Ctrl-C      stop: dialogues that are over are kept, this one begins anew
Answer in a sentence, such as "{}"; else it counts as not knowing."""
_NUMBERS = "There is no such number here: there is {}."
_AGAIN = """\
No answer is read in that: say it as "{}", or that you do not know.
What you type now is kept."""

_POINTS = re.compile(r"#(\d+)")
_WANTS = {
    "ask_name": "admit_name",
    "ask_quality": "admit_quality",
    "ask_place": "admit_place",
}
"""After what move of a robot a tutor tells what these questions are for."""


@dataclass(frozen=True, eq=False)
class TypedReply(Reply):
    """What a person has typed, what they claim by it, and at what they point.

    `about` is what there was to speak of: a thing, and what it is beside. What cannot
    be read is `odd`.
    """

    claimed: tuple[tuple[str, str], ...] = ()
    points: int | None = None
    about: tuple[int | None, ...] = ()
    odd: bool = False

    @property
    def way(self) -> str:
        """How it is put: what is claimed is asserted."""
        if self.points is not None:
            return "point"
        return "assert" if self.claimed else "admit"

    @property
    def wants(self) -> str:
        """What the person wants to be told, if they ask or cannot be read."""
        if self.odd and not self.asks:
            return "ask_again"
        return next((_WANTS[it] for it in self.acts if it in _WANTS), "")

    @property
    def is_lost(self) -> bool:
        """Never: a person understands."""
        return False

    @property
    def asks(self) -> bool:
        """Whether it is a question."""
        return self.text.endswith("?") or any(it.startswith("ask_") for it in self.acts)

    @property
    def is_open(self) -> bool:
        """Whether the person asks back, and not for the answer itself."""
        return self.asks and not self.wants

    @property
    def pointed_thing(self) -> int | None:
        """The thing whose number is named."""
        return self.points

    @property
    def things(self) -> tuple[int | None, ...]:
        """What there is to speak of."""
        return self.about

    @property
    def word(self) -> str:
        """The first word that is claimed."""
        return next((word for _, word in self.claimed), "")

    def claimed_word(self, kind: str) -> str:
        """The word of a kind that is claimed, the last of several: it sets right."""
        return dict(self.claimed).get(kind, "")


class TypedRobot:
    """The robot as a person plays it; `ask` shows a text and gives the line typed."""

    def __init__(self, language: str = "en", ask: Ask = read_line) -> None:
        self._language, self._ask = language, ask
        self._state, self._model = initial(), blank_model()
        self._before = f"\n{self._help()}"
        self._seen = ""
        self._occasion: Occasion | None = None

    def see(self, occasion: Occasion) -> Reply:
        """Keep what is seen: it is shown with what is said next."""
        self._occasion = occasion
        self._seen = f"\n{format_view(occasion, occasion.world_seen)}"
        return self._reply("")

    def wait(self, occasion: Occasion) -> Reply:
        """Let the person say something."""
        self.see(occasion)
        return self._reply(self._line("The tutor waits: you may say something."))

    def hear(self, text: str) -> Reply:
        """Let the person answer, once more if what they type is no answer."""
        kind = asked_kind(text, self._language)
        line = self._line(f"Tutor: {text}")
        if kind and not self._is_answer(line, kind):
            line = self._line(_AGAIN.format(example(kind, self._language)))
        return self._reply(line)

    def happen(self, command: str) -> Reply:
        """Show what a script has happen; at a look, the person may say something."""
        now = self._occasion
        if command == "restart":
            return self.rest()
        if now is not None and command == "look":
            return self.wait(now.look_again())
        if now is None or now.view is not None:
            self._before += f"\nWhat happens: {command}"
            return self._reply("")
        return self.see(occasion_after(now, command))

    def rest(self) -> Reply:
        """Say that another day begins."""
        self._before += "\nAnother day begins: you know what you were taught."
        return self._reply("")

    def name(self, number: int) -> str | None:
        """None: nothing is known of how a person names things."""
        return None

    def close(self) -> None:
        """There is nothing to release."""

    # --- what they see and type ------------------------------------------------------

    def _line(self, told: str) -> str:
        """Show what has happened since the last line, and read the next one."""
        before, self._before, self._seen = f"{self._before}{self._seen}", "", ""
        line = self._read(f"{before}\n{told}" if before else told)
        while line == "?" or (
            _POINTS.search(line) and self._thing_pointed_at(line) is None
        ):
            line = self._read(self._help() if line == "?" else self._numbers())
        return "" if line == "." else line

    def _read(self, told: str) -> str:
        return self._ask(f"{told}\nRobot (you): ").strip()

    def _help(self) -> str:
        return _HELP.format(example("noun", self._language))

    def _numbers(self) -> str:
        known = ", ".join(f"#{it}" for it in self._in_view)
        return _NUMBERS.format(known or "nothing")

    @property
    def _in_view(self) -> tuple[int, ...]:
        return () if self._occasion is None else self._occasion.world_seen.in_view

    # --- what is made of it ----------------------------------------------------------

    def _thing_pointed_at(self, line: str) -> int | None:
        """The first thing in view whose number is named."""
        known = {str(it): it for it in self._in_view}
        return next((known[it] for it in _POINTS.findall(line) if it in known), None)

    def _is_answer(self, line: str, kind: str) -> bool:
        """Whether it says what was asked, or that this is not known, or asks back."""
        if not line or line.endswith("?"):
            return True
        if kind == "reference":
            return self._thing_pointed_at(line) is not None
        moves = acts(line, self._language)
        return "okay" in moves or kind in dict(claimed_words(line, self._language))

    def _reply(self, line: str) -> Reply:
        text, model = _POINTS.sub("", line), self._model
        read, now = sentences(text, self._language), self._occasion
        points = self._thing_pointed_at(line)
        return TypedReply(
            line,
            tuple(_move(it.readings[0], model) for it in read if it.readings),
            self._state,
            model,
            claimed=claimed_words(text, self._language),
            points=points,
            about=() if now is None else (now.x, now.y),
            odd=points is None and any(not it.readings for it in read),
        )


def _move(reading: Utterance, model: Model) -> Judgement:
    """What was said, as a judgement that is certain."""
    said = record()
    return Judgement(
        said, reading.type, CERTAIN, lambda: model.judge(said, reading.type).why, model
    )
