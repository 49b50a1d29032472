"""`kille talk`: a conversation with the user as tutor, from a keyboard or a pipe."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext
from functools import partial
from pathlib import Path
from threading import Thread
from typing import Any

from kille.agent.agent import Agent
from kille.agent.commands import COMMANDS, answer_command, normalise_command
from kille.agent.spoken_turns import answer_hypotheses, tell_uttered
from kille.agent.story_log import StoryLog
from kille.agent.story_replay import language_of_file
from kille.dialogue.language import LANGUAGES
from kille.dialogue.language_files import plain
from kille.dialogue.robust_reading.text_hearing import prepare_to_read
from kille.interfaces.formatting import (
    Account,
    introduction,
    things_in_view,
    whole_account,
)
from kille.interfaces.live_prompt import (
    Show,
    can_watch,
    is_key_pressed,
    keys_at_once,
    wait_for_key,
)
from kille.interfaces.speech_input import SpeechHypotheses, SpeechInput
from kille.interfaces.terminal import FINE, complain, console, memory_path
from kille.memory import Memory, MemoryFileError
from kille.safety.private_files import create_private_file
from kille.sensors.sensor import SensorError
from kille.speech.sound import SoundError
from kille.speech.synthesis import SYNTHESISERS, Stop, Voice, voice
from ttr import TTRError
from ttr.dialogues.stories import StoryError
from ttr.safety.files import why_unwritten
from ttr.safety.inputs import ask_line
from ttr.safety.limits import UTTERANCE, InputLimitError

_PROMPT = "U> "

_POINTING = re.compile(r"#[0-9]{1,6}")


def talk(
    sensor: str,
    memory: Path | None,
    account: Account,
    *,
    language: str = "en",
    mode: str = "",
    wording: str = "",
    hear: str = "",
    say: str = "none",
    log: Path | None = None,
    live: bool = False,
    barge_in: bool = False,
    make: Callable[..., Agent] = Agent,
) -> int:
    """Talk until the tutor leaves, with an account of each turn; returns the exit code.

    `hear` is where speech comes from, if the tutor does not type; `say` names the
    voice. `log` is where the dialogue is written as a story. A `live` robot takes the
    turn after a silence; with `barge_in` who speaks over it stops it. `make` makes the
    robot.
    """
    place = memory_path(memory)
    settings: dict[str, Any] = {"language": language, "mode": mode, "wording": wording}
    if live:
        if hear or not can_watch():
            return complain("--live needs a terminal to type at: leave it out")
        settings["turns"] = "lively"
    with ExitStack() as closing:
        try:
            _check_apart(hear, say)
            speaks = voice(say, plain(language))
            if barge_in and not hear:
                raise SoundError("--barge-in needs an open microphone: --hear always")
            ears = SpeechInput(hear, language, barge_in) if hear else None
            if log is None:
                robot = closing.enter_context(make(sensor, place, **settings))
            else:
                story = closing.enter_context(_open_log(log, language))
                robot = closing.enter_context(
                    _logged_robot(
                        partial(make, sensor, place, **settings), story, place
                    )
                )
        except (SensorError, MemoryFileError, SoundError, StoryError) as error:
            return complain(error)
        closing.enter_context(_line_editing())
        try:
            aloud = say in SYNTHESISERS
            _Conversation(robot, account, ears, speaks, language, aloud).hold()
        except SoundError as error:
            return complain(error)
        except InputLimitError as error:
            return complain(f"the input cannot be read: {error.strerror}")
    return FINE


def _open_log(path: Path, language: str) -> StoryLog:
    """The log of a talk in a language, which the name of its file has to say."""
    spoken = plain(language)
    if path.suffix != ".dlg" or language_of_file(path) != spoken:
        ending = ".dlg" if spoken == LANGUAGES[0] else f".{spoken}.dlg"
        raise StoryError(f"{path} is no name for a log: call it NAME{ending}")
    try:
        return StoryLog(path)
    except OSError as error:
        raise StoryError(why_unwritten(path, error)) from error


def _logged_robot(make: Callable[..., Agent], log: StoryLog, memory: Path) -> Agent:
    """The robot whose events are logged, beside a copy of the memory it begins with."""
    copied = ""
    if memory.exists():
        copy = log.path.with_suffix(".memory.db")
        try:
            with Memory.open_to_read(memory) as reader:
                reader.copy_to(copy)
        except OSError as error:
            raise StoryError(why_unwritten(copy, error)) from error
        copied = copy.name
    robot = make(record_event=log)
    strategy = robot.state.private.strategy
    chosen = (strategy.mode, strategy.wording, strategy.turns.name)
    log.begin(robot.gaze.sensor.name, robot.time, chosen, copied)
    return robot


def _check_apart(hear: str, say: str) -> None:
    """Writing what is said must not overwrite what is to be heard."""
    if hear and os.path.realpath(hear) == os.path.realpath(say):
        raise SoundError(f"{hear} is what is to be heard: give --say another file")


class _Conversation:
    """A conversation in a terminal, through a pipe, or aloud."""

    def __init__(
        self,
        robot: Agent,
        account: Account,
        ears: SpeechInput | None,
        speak: Voice,
        language: str,
        aloud: bool,
    ) -> None:
        self._robot, self._account, self._language = robot, account, language
        self._ears, self._speak, self._aloud = ears, speak, aloud
        self._leaving = self._cut_off = False
        self._out = console()
        self._typed = ears is None and sys.stdin.isatty()
        self._failure = ""
        turns = robot.state.private.strategy.turns
        self._live = self._typed and can_watch() and max(turns.remark, turns.ask) > 0.0

    def hold(self) -> None:
        """Listens line by line until the end of the input or a farewell."""
        if self._typed:
            self._welcome()
        self._answer("@ look")
        if self._typed:
            prepare = partial(prepare_to_read, self._language, types=self._robot.types)
            Thread(target=prepare, daemon=True).start()  # while the tutor types
        for line in self._lines():
            if isinstance(line, SpeechHypotheses) or not sys.stdin.isatty():
                self._print(
                    f"U> {line.text if isinstance(line, SpeechHypotheses) else line}"
                )
            self._answer(line)
            if self._leaving:
                return

    def _welcome(self) -> None:
        self._print(
            f"{introduction(self._robot)}\n"
            'Say "This is a cup." or "What is this?"; help says what else.'
        )

    def _lines(self) -> Iterator[str | SpeechHypotheses]:
        """What the tutor says or types, without empty lines from a pipe."""
        if self._ears is not None:
            yield from self._ears.lines(self._robot)
            return
        while True:
            if self._live:
                wait_for_key(_PROMPT, self._watch)
            try:
                line = ask_line(_PROMPT if self._typed else "", UTTERANCE).strip()
            except EOFError:
                if self._typed:
                    self._print("")
                return
            # Who pressed Enter to stop the voice has not given the floor to the robot.
            stopped, self._cut_off = self._cut_off, False
            if line or (self._typed and not stopped):
                yield line

    def _answer(self, line: str | SpeechHypotheses) -> None:
        """Do what a line says; a failure is one line, and the conversation goes on."""
        turns = len(self._robot.exchanges)
        try:
            answer = self._respond(line)
        except (SensorError, MemoryFileError, TTRError) as error:
            complain(error)
            return
        self._leaving = self._has_said("Part")
        self._say(answer, turns)

    def _watch(self) -> Show | None:
        """Watch while nobody types; returns what shows what the robot then says."""
        turns, failure = len(self._robot.exchanges), self._failure
        try:
            answer = self._robot.watch(lambda: not is_key_pressed())
        except (SensorError, MemoryFileError, TTRError) as error:
            self._failure = str(error)
            # A camera that is gone is told once, not twice a second.
            return None if self._failure == failure else partial(complain, error)
        self._failure = ""
        return partial(self._show_remark, turns, answer) if answer else None

    def _show_remark(self, turns: int, answer: str) -> None:
        for turn in self._robot.exchanges[turns:]:
            self._print_account(self._account(turn))
        self._say(answer, turns)

    def _say(self, answer: str, turns: int) -> None:
        """Print and speak what the robot says in the turns after so many.

        A key stops the voice; what was not spoken then is not said.
        """
        if not answer:
            return
        sentences = answer.split("\n")
        uttered: list[str] = []
        with self._watch_for_stops() as stop:
            for sentence in sentences:
                self._print(sentence if sentence.startswith(" ") else f"S> {sentence}")
                spoken = self._speak(sentence, stop)
                uttered.append(spoken)
                if spoken != sentence:
                    self._print(f"   (cut off after {spoken!r})", style="dim")
                    break
        if self._aloud:
            self._cut_off |= tell_uttered(self._robot, " ".join(uttered), turns)

    @contextmanager
    def _watch_for_stops(self) -> Iterator[Stop]:
        """Watch for what stops the voice: a key, or somebody who speaks over it."""
        with ExitStack() as watching:
            stops: list[Stop] = []
            if self._aloud and can_watch():
                watching.enter_context(keys_at_once())
                stops.append(is_key_pressed)
            if self._aloud and self._ears is not None:
                stops.append(watching.enter_context(self._ears.watch_for_voice()))
            yield lambda: any(stop() for stop in stops)

    def _respond(self, line: str | SpeechHypotheses) -> str:
        if isinstance(line, SpeechHypotheses):
            return self._take_turn(
                lambda: answer_hypotheses(self._robot, line.perhaps, self._language)
            )
        if line.startswith("@"):
            return self._command(line)
        if _POINTING.fullmatch(line) and not self._robot.state.shared.qud:
            return self._command(f"point {line}")
        return self._take_turn(lambda: self._robot.hear(line))

    def _take_turn(self, take: Callable[[], str]) -> str:
        """Take a turn, and print an account of it; returns the robot's answer."""
        turns = len(self._robot.exchanges)
        answer = take()
        for turn in self._robot.exchanges[turns:]:
            self._print_account(self._account(turn))
        if self._has_said("GiveHelp"):
            answer += "".join(f"\n  {command}" for command in COMMANDS.splitlines())
        return answer

    def _command(self, command: str) -> str:
        command = normalise_command(command)
        verb = command.partition(" ")[0]
        if verb == "trace":
            return self._trace()
        shown = answer_command(self._robot, command)
        if shown is not None:
            self._print(shown)
            return ""
        answer = self._robot.do(command)
        if verb == "point":
            answer = self._robot.look()
        self._show_view()
        return answer

    def _trace(self) -> str:
        """Shows all that the latest turn did, whatever `--trace` shows of each."""
        latest = self._robot.exchanges[-1:]
        lines = [line for turn in latest for line in whole_account(turn)]
        self._print_account(lines or ["The latest turn changed nothing."])
        return ""

    def _print_account(self, lines: Iterable[str]) -> None:
        for line in lines:
            self._print(line, style="dim")

    def _show_view(self) -> None:
        if self._robot.view is not None:
            self._print(things_in_view(self._robot.view))

    def _has_said(self, act: str) -> bool:
        """Whether the robot's latest turn was such an act."""
        T = self._robot.types.record_type(act)
        return any(
            said.judgement is not None and said.judgement.type <= T
            for turn in self._robot.exchanges[-1:]
            for said in turn.said
        )

    def _print(self, text: str, style: str = "") -> None:
        self._out.print(text, markup=False, style=style or None)


@contextmanager
def _line_editing() -> Iterator[None]:
    """Line editing and a history over sessions, where the terminal can have them."""
    try:
        import readline
    except ImportError:
        yield
        return
    if not sys.stdin.isatty():
        yield
        return
    history = memory_path(None).with_name("history")
    try:
        readline.read_history_file(history)
    except OSError:
        readline.clear_history()
    # What is typed while the robot works waits for the next line as it is: a terminal
    # that reads whole lines by then would turn Ctrl-D into a key that does nothing.
    try:
        with keys_at_once(echo=True) if can_watch() else nullcontext():
            yield
    finally:
        readline.set_history_length(1000)
        try:
            history.parent.mkdir(parents=True, exist_ok=True)
            create_private_file(history)
            readline.write_history_file(history)
        except OSError:
            complain(f"the history could not be kept in {history}")
