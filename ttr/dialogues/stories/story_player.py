"""Playing a story with a game, and comparing what happens with the story."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from ttr.aliases import Alias
from ttr.computing.subtyping import subtype
from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.dialogues.settings import Setting
from ttr.dialogues.stories.line_events import event_of_line, type_of_text
from ttr.dialogues.stories.mismatches import SILENCE, Mismatch
from ttr.dialogues.stories.story_opening import opening, setting_of, turns_of
from ttr.dialogues.stories.story_reader import Line, Story
from ttr.errors import NotHeardError, TTRError
from ttr.judging.judgements import Judgement
from ttr.probability import CERTAIN
from ttr.showing import NotebookValue, Part, Text, below
from ttr.types.printing import notation
from ttr.updates import Step

Echo = Callable[[str], None]

_Said = tuple[Judgement, str]
"""A move of the system, and its words."""


@dataclass(frozen=True)
class Played(NotebookValue):
    """A story that was played: the dialogue, and where it differs, if it does.

    It ends where it first differs.

    >>> from ttr import Theory
    >>> from ttr.dialogues.stories import Line
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> story = Story("one name", (Line("a.dlg", 1, "U>", "ann"),))
    >>> played = play(story, Setting.of(theory.games["notes"], theory))
    >>> print(played.dialogue.now.state, played.mismatch)
    {heard = [ann]} None
    """

    story: Story
    dialogue: Dialogue
    mismatch: Mismatch | None

    setting = Alias("dialogue.setting")
    start = Alias("dialogue.start")
    moments = Alias("dialogue.trials")

    def _shown_as_(self) -> Part:
        wrong = self.mismatch
        if wrong is None:
            verdict = Text("played as it is written", "yes")
        else:
            verdict = Text(f"differs from {wrong.line.place} on", "no")
        return below(verdict, self.dialogue._shown_as_())


def play(
    story: Story,
    setting: Setting | None = None,
    *,
    echo: Echo = lambda line: None,
    witness: Callable[[Trial], None] = lambda trial: None,
) -> Played:
    """Plays a story with a game: the one given, or the one that the story names.

    `echo` is given each line as it is played, `witness` each turn when it is over.
    Raises `StoryError` for a line that cannot be played.

    >>> from ttr import Theory
    >>> from ttr.dialogues.stories import Line
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> story = Story("one name", (Line("a.dlg", 1, "U>", "ann"),))
    >>> story = Story("an answer", (*story.lines, Line("a.dlg", 2, "S>", "Hello.")))
    >>> print(play(story, Setting.of(theory.games["notes"], theory)).mismatch)
    a.dlg:2
      expected: Hello.
         found: silence
      the rules of this turn:
        note
          heard: + ann
    """
    setting = setting or setting_of(story)
    opened = opening(story, setting)
    playing = _Playing(opened, echo, witness)
    mismatch = playing.play(story)
    ending = "" if mismatch is None else str(mismatch)
    dialogue = Dialogue(
        opened.game, tuple(playing.trials), story.title, setting, ending=ending
    )
    return Played(story, dialogue, mismatch)


# --- playing -------------------------------------------------------------------------


class _Playing:
    """A story being played; `_said` has the words that the story has not yet had."""

    def __init__(
        self, setting: Setting, echo: Echo, witness: Callable[[Trial], None]
    ) -> None:
        self.setting, self._echo, self._witness = setting, echo, witness
        self._now = setting.game.begin()
        self.trials: list[Trial] = []
        self._said: list[_Said] = []

    def play(self, story: Story) -> Mismatch | None:
        for line in turns_of(story):
            mismatch = self._step(line)
            if mismatch is not None:
                return mismatch
        return self._unexpected_words(story.lines[-1])

    def _step(self, line: Line) -> Mismatch | None:
        match line.mark:
            case "S>" | "S~":
                return self._compare_words(line)
            case "=":
                return self._check_state(line)
        return self._unexpected_words(line) or self._take_turn(line)

    def _take_turn(self, line: Line) -> Mismatch | None:
        happening = event_of_line(self.setting, self._now, line)
        told = f"{line.mark} {line.text}".rstrip()
        self._echo(told)
        try:
            turn = self.setting.game.take(self._now, happening)
            trial = Trial.of(turn, self.setting, told)
        except NotHeardError as error:
            raise line.wrong(error.message) from error
        except TTRError as error:
            self._said = []
            return Mismatch(line, "a turn without an error", error.message)
        self._now = turn.run
        said = zip(turn.said, trial.said, strict=True)
        self._said = [(move, words) for move, words in said if words]
        self.trials.append(trial)
        self._witness(trial)
        for _, words in self._said:
            self._echo(f"S> {words}")
        return None

    # --- what the system says ---

    def _compare_words(self, line: Line) -> Mismatch | None:
        found = self._said.pop(0) if self._said else None
        if found is None:
            return self._mismatch_at(line, SILENCE) if line.text else None
        move, words = found
        if line.text and self._fits(line, move, words):
            return None
        mismatch = self._mismatch_at(line, words)
        if line.mark == "S>" and line.text and self.setting.game.say is None:
            roughly = replace(line, mark="S~")
            if self._fits(roughly, move, words):
                hint = f"it is more than {line.text} says: write S~ {line.text}"
                return replace(mismatch, hint=hint)
        return mismatch

    def _fits(self, line: Line, move: Judgement, words: str) -> bool:
        """Is a move as the line says: to the letter, or roughly?"""
        if self.setting.game.say is not None:
            return words == line.text if line.mark == "S>" else fits(line, words)
        T = type_of_text(self.setting, self._now, line, line.text, 0)
        theory = self.setting.theory
        below = subtype(move.type, T, theory).yes
        return below and (line.mark == "S~" or subtype(T, move.type, theory).yes)

    def _unexpected_words(self, line: Line) -> Mismatch | None:
        """The mismatch that the system said more before this line than the story."""
        if not self._said:
            return None
        _, words = self._said[0]
        expected = "nothing more to be said before this"
        return Mismatch(line, expected, words, self._trace)

    # --- states ---

    def _check_state(self, line: Line) -> Mismatch | None:
        name, colon, text = line.text.partition(":")
        if not colon or name.strip() != "s":
            raise line.wrong("a judgement of the state is written `= s : T`")
        T = type_of_text(self.setting, self._now, line, text, len(name) + 1)
        try:
            judgement = self._now.model.judge(self._now.state, T)
        except TTRError as error:
            raise line.wrong(error.message) from error
        if judgement.p == CERTAIN:
            return None
        return self._mismatch_at(line, failure_reason(judgement))

    def _mismatch_at(self, line: Line, found: str) -> Mismatch:
        expected = (
            line.text.partition(":")[2].strip() if line.mark == "=" else line.text
        )
        return Mismatch(line, expected or SILENCE, found, self._trace)

    @property
    def _trace(self) -> tuple[Step, ...]:
        """The rules of the latest turn."""
        return self.trials[-1].steps if self.trials else ()


# --- differences ---------------------------------------------------------------------


def fits(line: Line, words: str) -> bool:
    """Do words match the regular expression of a line?

    Raises `StoryError` for what is no regular expression.

    >>> fits(Line("a.dlg", 1, "S~", "Hello.*"), "Hello, you.")
    True
    """
    try:
        return re.fullmatch(line.text, words) is not None
    except re.error as error:
        raise line.wrong(f"{line.text!r} is no regular expression: {error}") from None


def failure_reason(judgement: Judgement) -> str:
    """Where and why a judgement of the state fails.

    >>> from ttr import Ind, ListOf, Model, record, rectype
    >>> Board = rectype(qud=ListOf(Ind))
    >>> print(failure_reason(Model().judge(record(qud=["q1"]), Board)))
    at qud: q1 : Ind, nothing says so
    """
    failed = judgement.why.failure()
    if failed is None:
        return f"it is so with probability {judgement.p}"
    path = judgement.why.path() or "the state"
    return f"at {path}: {notation(failed.sit)} : {failed.type}, {failed.because}"
