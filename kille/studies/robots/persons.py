"""A person who plays the robot: who is shown what it sees, hears the tutor, and types.

What they claim is read as the tutor's own sentences are; whatever else they say counts
as not knowing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from kille.dialogue.language import Sentence, understand
from kille.dialogue.meanings import claims, is_denial, value_at
from kille.dialogue.state import blank_model, initial
from kille.studies.robots.replies import Reply
from kille.studies.scenes.occasions import Occasion
from kille.studies.tutors.keyboard import Ask, shown, typed
from ttr import Record, RecordType

__all__ = ["Typed"]


@dataclass(frozen=True, eq=False)
class TypedReply(Reply):
    """What a person has typed, and what they claim by it, kind by kind.

    What cannot be `read` as anything that one says is not knowing.
    """

    claimed: tuple[tuple[str, str], ...] = ()
    read: bool = True

    @property
    def way(self) -> str:
        """What is claimed is asserted."""
        return "assert" if self.claimed else "admit"

    @property
    def wants(self) -> str:
        """Who does not know wants to be told."""
        return "" if self.read else "ask_again"

    @property
    def is_lost(self) -> bool:
        """A person understands."""
        return False

    @property
    def asks(self) -> bool:
        """Whether it is a question."""
        return self.text.endswith("?")

    def said(self, kind: str) -> str:
        """The word of a kind that is claimed."""
        return dict(self.claimed).get(kind, "")


class Typed:
    """The robot as a person plays it; `ask` is given a prompt, and gives the line."""

    def __init__(self, language: str = "en", ask: Ask = typed) -> None:
        self._language, self._ask = language, ask
        self._state, self._model = initial(), blank_model()
        self._seen = ""

    def see(self, occasion: Occasion) -> Reply:
        """What is seen is told with what is said next."""
        self._seen = f"\nYou see: {shown(occasion.shown)}"
        return self._reply("")

    def wait(self, occasion: Occasion) -> Reply:
        """They may say something."""
        return self._answer(f"You see: {shown(occasion.shown)}\nIt is your turn")

    def hear(self, text: str) -> Reply:
        """They answer."""
        told, self._seen = f"{self._seen}\nTutor: {text}".lstrip(), ""
        return self._answer(told)

    def happen(self, command: str) -> Reply:
        """They are told."""
        return self._answer(f"What happens: {command}")

    def rest(self) -> Reply:
        """They are told that another day begins."""
        self._seen = "\nAnother day begins."
        return self._reply("")

    def name(self, number: int) -> str | None:
        """Nothing is known of what they call things."""
        return None

    def close(self) -> None:
        """Nothing is to be let go of."""

    def _answer(self, told: str) -> Reply:
        line = self._ask(f"{told}\nRobot (you): ").strip()
        return self._reply("" if line == "." else line)

    def _reply(self, text: str) -> Reply:
        sentences = understand(text, self._language) if text else ()
        claimed = tuple(_claimed(sentences))
        read = all(it.readings for it in sentences)
        state, model = self._state, self._model
        return TypedReply(text, (), state, model, claimed=claimed, read=read)


def _claimed(sentences: Iterable[Sentence]) -> Iterator[tuple[str, str]]:
    """The words that sentences claim to be true, each with its kind."""
    for sentence in sentences:
        for reading in sentence.readings[:1]:
            content, signs = value_at(reading.type, "content"), _signs(reading.type)
            if isinstance(content, RecordType) and not is_denial(content):
                yield from (
                    (str(it.kind), str(it.form)) for it in signs if claims(content, it)
                )


def _signs(said: RecordType) -> tuple[Record, ...]:
    signs = value_at(said, "signs")
    assert isinstance(signs, tuple)
    return signs
