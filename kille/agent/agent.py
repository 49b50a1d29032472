"""The robot: it looks, hears, updates its state, learns for good, and speaks."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from datetime import UTC, datetime
from decimal import Decimal
from pathlib import Path

from kille.agent.actions import MoveExecutor
from kille.agent.attention import (
    THAT,
    Attention,
    AttentiveSensor,
    NumberedLook,
    is_same_thing,
)
from kille.agent.commands import (
    answer_command,
    meant_command,
    normalise_command,
)
from kille.agent.dialogue_log import DialogueLog
from kille.agent.exchanges import (
    Event,
    EventClock,
    Exchange,
    RobotSentence,
    exchange_shown,
)
from kille.agent.explanations import criterion_of_lesson, kind_of_lesson, sign_of
from kille.agent.reason_pictures import reason_picture
from kille.agent.silence import Silence, missing_things
from kille.dialogue.beliefs import is_sure, names_of, thinks
from kille.dialogue.language import Sentence, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    DialogueTypes,
    predicate_at,
    set_to,
    types_of,
    word_of,
)
from kille.dialogue.robust_reading.situations import Situation, situation_of
from kille.dialogue.robust_reading.speech_hearing import (
    UncertainMove,
    hear_hypotheses_in_parts,
)
from kille.dialogue.robust_reading.text_hearing import (
    complete_answer,
    fill_noun,
    hear_in_parts,
    settle_moves,
)
from kille.dialogue.robust_reading.whole_sentences import needs_parts
from kille.dialogue.state import blank_model, words
from kille.dialogue.strategies import reckon_with_strangers
from kille.dialogue.tutoring import hear_sentences, tutoring
from kille.dialogue.wording import did_not_understand
from kille.grounding.lessons_and_learners import Knowledge, Learners
from kille.grounding.witness_functions import WitnessFunctions, thing_name
from kille.grounding.word_meanings import WordMeanings
from kille.memory import Memory, MemoryFileError
from kille.perception.look import SCANS
from kille.perception.prominence import prominences
from kille.perception.shown_looks import Picture, annotated_picture, view_shown
from kille.scene import Configuration, Percept
from kille.sensors.sensor import Sensor, SensorError
from kille.sensors.stage_commands import perform
from ttr import Model, Record, RecType, Theory, TTRError, record
from ttr.errors import UpdateError
from ttr.judging import Judgement
from ttr.probability import CERTAIN
from ttr.safety.closing import Closing
from ttr.semantics.perceptual import Meaning, Speaker
from ttr.showing import (
    SOME,
    Fold,
    NotebookValue,
    Part,
    Text,
    below,
    beside,
    count_of,
    name_list,
    table,
)
from ttr.types import Singleton
from ttr.updates import Game, Run, Step

_POINTING = re.compile(r"#([0-9]{1,6})\b")

_THIS_AND_THAT = 2

TUTOR = "tutor"

_UNTYPED = ("glimpse", "watch", "interrupt", "spoken", "meanwhile")
"""Commands of stories, which nobody types."""

WATCH, BUSY = "@ watch", "@ watch busy"
"""Looking while nobody speaks, and while somebody begins to, as lines of a story."""

TurnResult = tuple[Exchange, Run]
"""A turn, and the state and model that it leads to."""


class Agent(Closing, NotebookValue):
    """A robot that looks through a sensor and keeps what it learns in a memory.

    It is its own context manager. `hear` takes what the tutor says, `do` changes the
    scene, and both give the robot's answer. If the sensor or the memory raises a
    SensorError or a MemoryFileError, the state is as it was before the turn.

    >>> with Agent(sensor="synthetic:empty") as robot:
    ...     robot.hear("This is a cup.")
    'I see nothing on the table.'
    """

    def __init__(
        self,
        sensor: str | Sensor = "synthetic",
        memory: Memory | Path | str | None = None,
        *,
        language: str = "en",
        mode: str = "",
        wording: str = "",
        turns: str = "",
        scans: int = SCANS,
        now: Callable[[], datetime] = lambda: datetime.now(UTC),
        learners: Learners | None = None,
        theory: Theory | DialogueTypes | None = None,
        change: Callable[[Game], Game] | None = None,
        record_event: Callable[[Event], None] | None = None,
    ) -> None:
        """A robot that is awake; other `learners` may judge its words.

        Its games, its language and its meanings follow from the `theory`, by default
        the packaged one. `change` gives the game that it plays instead of its own.
        `now` is its clock, which it reads once for each event; `record_event` is given
        every event after it has happened.
        """
        self.types = types_of(theory)
        self.gaze = AttentiveSensor(sensor, scans)
        self.language = language
        self._mode, self._wording, self._turns = mode, wording, turns
        self._clock, self._record_event = EventClock(now), record_event
        self._learners, self._change = learners, change
        self._lexicon = lexicon(language)
        self.exchanges: list[Exchange] = []
        with ExitStack() as failing:
            failing.callback(self.gaze.close)
            opened = _open_memory(memory)
            failing.callback(opened.close)
            self._wake(opened)
            failing.pop_all()

    def _wake(self, memory: Memory) -> None:
        """Begin a dialogue, knowing what the memory holds."""
        knowledge = Knowledge(memory, self._learners)
        witnesses = WitnessFunctions.of(knowledge)
        colours = tuple(self._colour_words(knowledge.colours.labels))
        counts = memory.counts()
        taught = [
            record(
                sign=sign_of(it, self.types), lessons=float(counts[it.kind, it.name])
            )
            for it in memory.words()
        ]
        kinds = [
            kind_of_lesson(it, knowledge.memory, self.types)
            for it in knowledge.memory.kinds()
        ]
        criteria = [
            criterion_of_lesson(it, self.types) for it in knowledge.memory.criteria()
        ]
        signs = (
            *colours,
            *(it.sign for it in taught),
            *(sign for it in kinds for sign in it.signs),
        )
        known = list({word_of(it): it for it in signs}.values())
        self._looks = 0
        self.memory, self._knowledge, self._witnesses = memory, knowledge, witnesses
        self._log = DialogueLog(memory, self._clock)
        executor = MoveExecutor(
            knowledge, witnesses, self.gaze, self._log, self._clock, self.types
        )
        game = tutoring(
            known,
            language=self.language,
            mode=self._mode,
            wording=self._wording,
            turns=self._turns,
            model=witnesses.in_model(blank_model(self.types), known, types=self.types),
            act=executor.act,
            colours=colours,
            taught=taught,
            kinds=kinds,
            criteria=criteria,
            types=self.types,
        )
        self.game: Game = game if self._change is None else self._change(game)
        self._now_at = self.game.begin()
        self._silence = Silence.begin(self._clock())
        self._latest: Exchange | None = None

    def _colour_words(self, known: Iterable[str]) -> Iterator[Record]:
        """The words of its language for colours that people have named for it."""
        by_meaning = {means: form for form, means in self._lexicon.means.items()}
        for name in known:
            form = by_meaning.get(name, "" if by_meaning else name)
            if form:
                yield self.types.sign(form, "adjective", means=name)

    @property
    def state(self) -> Record:
        """The information state: all that it knows of the dialogue."""
        return self._now_at.state

    @property
    def model(self) -> Model:
        """The model in which its judgements are made."""
        return self._now_at.model

    @property
    def time(self) -> datetime:
        """When the latest event happened: at first, that the robot woke."""
        return self._clock()

    # --- what a user does ------------------------------------------------------------

    def hear(self, text: str) -> str:
        """Take in what the tutor says; the robot's answer, a sentence a line.

        `#2` in the text points at the thing with that number; of two, the second is
        "that" beside "this". An empty text leaves the floor to the robot. A text that
        is not understood leaves the state as it was.
        """
        text = _legible(text)
        return self._happen(
            f"U> {text}", lambda: self._take_turn(lambda: self._hear_text(text))
        )

    def hear_perhaps(self, *texts: tuple[str, float]) -> str:
        """Take in what the tutor perhaps says: one of these texts, each so probable.

        Each is one move. The robot asks about what it did not hear well enough. Where
        the grammar reads none of them, they are read by their parts, and teach nothing
        without a question. Raises `UpdateError` for invalid probabilities, or if they
        sum to more than 1.
        """
        _check_probable(texts)
        alternatives = (f"{_legible(text)} {_decimal(p)}" for text, p in texts)
        return self._happen(
            f"U~ {' | '.join(alternatives)}",
            lambda: self._take_turn(lambda: self._hear_alternatives(texts)),
        )

    def look(self) -> str:
        """Look at the scene unasked; returns what the robot then says, if anything.

        It may ask about what it sees.
        """
        return self._happen("@ look", lambda: self._take_turn(self._look_around))

    def watch(self, is_free: Callable[[], bool] = lambda: True) -> str:
        """Look while nobody speaks; returns what it says if it takes the turn.

        It does so after a silence that its strategy sets: by default never. `is_free`
        is asked when it has looked: by then somebody may have begun to speak or type.
        """
        free: list[bool] = []

        def ask_free() -> bool:
            free.append(is_free())
            return free[-1]

        return self._happen(
            lambda: WATCH if all(free) else BUSY,
            lambda: self._take_turn(lambda: self._watch(ask_free)),
        )

    def interrupt(self, uttered: str) -> None:
        """Take in that the tutor has spoken over it, and how much it had uttered.

        The rest of its latest answer is not said. Raises `UpdateError` for a text that
        does not begin that answer.
        """
        self._happen(
            f"@ interrupt {uttered}".strip(),
            lambda: self._take_turn(lambda: self._cut_off(uttered)),
        )

    def do(self, command: str) -> str:
        """Carry out a command, as after `@` in `kille talk`; returns what comes of it.

        What only asks is answered: `picture`, `why`, `meaning cup`, `trace`, `things`
        and `help` give what `kille talk` prints. All else is a `change_scene`. The @
        may be there, and the verb begin with a capital. Raises
        `TTRError` for what is misspelt and where there is nothing to show.

        >>> with Agent(sensor="synthetic:empty?seed=7") as robot:
        ...     robot.do("help").splitlines()[1]
        '  @ show cup                    only the cup is on the table'
        """
        command = normalise_command(command)
        answer = answer_command(self, command)
        if answer is not None:
            return answer
        verb = command.partition(" ")[0]
        if near := meant_command(verb) if verb not in _UNTYPED else "":
            raise TTRError(f"there is no command @ {verb}: did you mean @ {near}?")
        return self.change_scene(command)

    def change_scene(self, command: str) -> str:
        """Change the scene, and look; returns what the robot then says, if anything.

        It is for commands from elsewhere, as in a story or on a bus: it writes no file.
        Commands are those of `kille.sensors.stage_commands`, also after `meanwhile`,
        with which the robot does not look; and `look`, `glimpse`, a look that is no
        turn, as for a picture, `watch`, `point 2`, `point 320 240`, `scene SENSOR` and
        `restart`; `point 90 60 210 200` points at a box: left, top, right and bottom.
        `interrupt TEXT` is `interrupt`; `spoken` says that all of the latest answer has
        been uttered now. Pointing and restarting take no look.
        """
        if command.partition(" ")[0] == "watch":
            return self.watch(lambda: "busy" not in command)
        return self._happen(f"@ {command.strip()}", lambda: self._do(command))

    def _do(self, command: str) -> str:
        verb, _, rest = command.strip().partition(" ")
        match verb:
            case "point":
                self.gaze.point(rest)
                return ""
            case "glimpse":
                self.gaze.glimpse()
                return ""
            case "restart":
                self._wake(self.memory)
                return ""
            case "scene":
                self.gaze.switch_sensor(rest)
            case "look":
                pass
            case "interrupt":
                return self._take_turn(lambda: self._cut_off(rest))
            case "spoken":
                return ""
            case "meanwhile":
                perform(self.gaze.sensor, rest)
                return ""
            case _:
                self.gaze.change(command)
        return self._take_turn(self._look_around)

    def words(self) -> Speaker:
        """Its words as perceptual meanings, as it knows them now.

        They judge what is in the looks that it remembers. To teach them gives new
        meanings: the robot neither keeps nor knows what they learn.
        """
        known = self._knowledge
        vocabulary = WordMeanings(self._witnesses, known.objects, known.relations)
        private = self.state.private
        return vocabulary.speaker("robot", private.nouns, private.relations)

    def meaning(self, word: str) -> Meaning:
        """One of its words as a perceptual meaning; `TTRError` if it knows none such.

        >>> with Agent(sensor="synthetic:empty?seed=7") as robot:
        ...     _ = robot.do("show cup")
        ...     _ = robot.hear("This is a cup.")
        ...     print(robot.meaning("cup").params)
        {labels = [cup], learner = <Handle ObjectMemory>}
        """
        return self.words()[word]

    def spatial_degrees(
        self, name: str, places: Sequence[tuple[float, float]]
    ) -> list[float]:
        """How well a relation holds of things at these places, each from 0 to 1.

        A place is in metres right of and away from the landmark, as the viewer sees it;
        0 everywhere for a relation that it was never taught.
        """
        placed = [Configuration((right, away, 0.0)) for right, away in places]
        found = self._knowledge.relations.degrees_of(placed)
        return [float(it.get(name, 0.0)) for it in found]

    def hindsight(self, name: str, latest: int = 24) -> Iterator[bool]:
        """Whether it would have named the thing of each of the latest lessons in a noun
        rightly, by the lessons before it: its learning curve, from the earliest on.

        A denial is right if the noun is not its best guess. It is worked out as it is
        asked for, by the lessons of now, and may be so in another thread.

        >>> with Agent(sensor="synthetic:empty?seed=7") as robot:
        ...     _ = robot.do("show cup")
        ...     _ = robot.hear("This is a cup.")
        ...     _ = robot.hear("This is a cup.")
        ...     list(robot.hindsight("cup"))
        [False, True]
        """
        return self._knowledge.hindsight(name, latest)

    def names_in_view(self) -> tuple[str, ...]:
        """What it would call each thing in its latest view, by their numbers.

        With a question mark where it is not sure, and empty where it does not know, or
        where another thing lies there than at its latest turn.
        """
        return tuple(map(self._name_by, self.beliefs_in_view()))

    def beliefs_in_view(self) -> tuple[Sequence[Record], ...]:
        """How probably each noun is true of each thing in view, by their numbers.

        The beliefs of a thing begin with the name that it would be called by, followed
        by its rivals. There are none where another thing lies than at its latest turn.
        """
        things = () if self.view is None else self.view.look.percepts
        return tuple(self._beliefs_of(*it) for it in enumerate(things, start=1))

    def _beliefs_of(self, number: int, thing: Percept) -> Sequence[Record]:
        s, x = self.state, thing_name(number)
        before = self._witnesses.percept(x, s.view.look)
        if x not in s.view.things or before is None:
            return ()
        return names_of(s, self.model, x) if is_same_thing(before, thing) else ()

    def _name_by(self, beliefs: Sequence[Record]) -> str:
        """What it would call a thing of which it believes this."""
        s = self.state
        if not thinks(s, beliefs):
            return ""
        return f"{beliefs[0].sign.form}{'' if is_sure(s, beliefs) else '?'}"

    def picture(self) -> Picture:
        """What is in view now, with each thing outlined, numbered and named.

        It is a value: a notebook shows it, `picture().save("view.png")` writes it. The
        robot looks for it, but takes no turn. SensorError as the sensor raises it.

        >>> with Agent(sensor="synthetic:empty?seed=7") as robot:
        ...     _ = robot.do("show cup")
        ...     robot.picture()
        <Picture of 640 x 480 pixels: things in view: 1 of them>
        """
        self.change_scene("glimpse")
        assert self.view is not None
        return annotated_picture(self.view.look, self.names_in_view(), self.view.roles)

    def _shown_as_(self) -> Part:
        view = self.view
        return below(
            beside(
                Text("a robot", "strong"),
                Text(f"that looks through {self.gaze.sensor.name}", "quiet"),
            ),
            Text("It has not looked yet.", "quiet")
            if view is None
            else view_shown(view.look, self.names_in_view(), view.roles),
            exchange_shown(self._latest) if self._latest is not None else None,
            _words_shown([*words(self.state)]),
        )

    def __repr__(self) -> str:
        known = count_of(len([*words(self.state)]), "word")
        return f"<Agent that looks through {self.gaze.sensor.name} and knows {known}>"

    def reason_picture(self) -> Picture | None:
        """The reason that it gave last, as a picture: a notebook shows it.

        What it saw and the lesson that it was reminded of are side by side, with the
        details that both have, and how much each cue counted. None if it has given no
        reason. Raises ValueError if the picture of the lesson cannot be decoded.
        """
        for exchange in reversed(self.exchanges):
            for said in reversed(exchange.said):
                picture = reason_picture(
                    said, self._witnesses, self.memory, self._lexicon
                )
                if picture is not None:
                    return picture
        return None

    @property
    def view(self) -> NumberedLook | None:
        """The latest view of the scene, with the numbers of the things in it."""
        return self.gaze.attention.view

    @property
    def trace(self) -> tuple[Step, ...]:
        """Every rule that ran, in order, with the states before and after it."""
        return tuple(step for exchange in self.exchanges for step in exchange.steps)

    def close(self) -> None:
        """Let go of the sensor and the memory."""
        self.gaze.close()
        self.memory.close()

    # --- taking turns ----------------------------------------------------------------

    def _happen(self, line: str | Callable[[], str], event: Callable[[], str]) -> str:
        """Let an event happen now, and record it; returns what the robot then says.

        What the event was may only be known when it has happened.
        """
        self._clock.go_on()
        answer = event()
        line = line if isinstance(line, str) else line()
        if answer or line != WATCH:
            self._silence = Silence.begin(self._clock())
        if self._record_event is not None:
            said = tuple(answer.split("\n")) if answer else ()
            self._record_event(Event(self._clock(), line, said))
        return answer

    def _take_turn(self, turn: Callable[[], TurnResult]) -> str:
        """Take a turn and keep it for good, or none of it if anything fails.

        The state is taken over, and the answer given, when all of it is on disk.
        """
        attention = self.gaze.attention
        try:
            with self._knowledge.together(), self._log.all_or_nothing():
                exchange, after = turn()
        except BaseException as error:
            self.gaze.attention = attention
            self._witnesses.reconsider()
            cause = _cause(error)
            if cause is None:
                raise
            raise cause from cause.__cause__
        self._now_at = after
        if exchange.text:
            self.gaze.settle()
        if exchange.text or exchange.steps:
            self._latest = exchange
            self.exchanges.append(exchange)
        return exchange.answer

    def _hear_text(self, text: str) -> TurnResult:
        """Take in all that a text says, move by move."""
        numbers = _POINTING.findall(text)
        meant = fill_noun(text, self.state, self.language)
        words = _POINTING.sub(" ", meant).strip()
        sentences = self._sentences_with_numbers(meant, words) if numbers else ()
        if not sentences:
            for number in numbers:
                self.gaze.point(number)
            if len(set(numbers)) == len(numbers) == _THIS_AND_THAT:
                self.gaze.point(numbers[0])
                self.gaze.point(f"{THAT} {numbers[1]}")
            if not words.strip():
                if not numbers or not self.state.shared.qud:
                    return self._look_around()
                words = self._lexicon.pointing
            sentences = understand(words, self.language, types=self.types)
        exchange, now = Exchange(text, None, (), (), self._clock()), self._now_at
        full = [self._in_full(it, now.state) for it in sentences]
        situation = situation_of(now.state)
        if self.gaze.attention.anew:  # at what the next look shows
            situation = situation._replace(points_anew=True)
        if needs_parts(full, situation, self.language):
            return self._hear_in_parts(full, situation, exchange, now)
        for sentence in settle_moves(sentences, situation, types=self.types):
            sentence = self._in_full(sentence, now.state)
            exchange, now = self._answer(
                sentence, hear_sentences(sentence), exchange, now
            )
        return exchange, now

    def _hear_in_parts(
        self,
        sentences: Sequence[Sentence],
        situation: Situation,
        exchange: Exchange,
        now: Run,
    ) -> TurnResult:
        """Take in what is understood of sentences, and say what is not.

        A question of the robot's ends the turn: what follows would drop it.
        """
        heard = hear_in_parts(sentences, situation, self.language, types=self.types)
        for sentence, found in heard.missed:
            self._log.record_heard(sentence.text)
            sorry = did_not_understand(
                self._lexicon,
                sentence.text,
                found.parts,
                beside=bool(heard.moves),
                types=self.types,
            )
            self._log.record_said(sorry)
            exchange = exchange.then(None, (), (RobotSentence(sorry, None),))
        for sentence in heard.moves:
            exchange, now = self._answer(
                sentence, hear_sentences(sentence), exchange, now
            )
            if now.state.shared.qud:
                break
        return exchange, now

    def _hear_alternatives(self, texts: Sequence[tuple[str, float]]) -> TurnResult:
        """Take in a move that may have been said in one of several ways."""
        sentences = [
            understand(_legible(text), self.language, types=self.types)[0]
            for text, _ in texts
        ]
        text = " | ".join(f"{text} {p:g}" for text, p in texts)
        situation = situation_of(self.state)
        if all(needs_parts([it], situation, self.language) for it in sentences):
            return self._hear_alternatives_in_parts(texts, situation, text)
        move = UncertainMove(tuple(sentences), tuple(p for _, p in texts))
        so_far = Exchange(text, None, (), (), self._clock())
        return self._answer_uncertain(move, text, so_far, self._now_at)

    def _hear_alternatives_in_parts(
        self, texts: Sequence[tuple[str, float]], situation: Situation, text: str
    ) -> TurnResult:
        """Take in what is understood of texts of which the grammar reads none."""
        legible = [(_legible(it), p) for it, p in texts]
        now = self._now_at
        heard = hear_hypotheses_in_parts(
            legible, situation, self.language, types=self.types
        )
        if not heard.moves:
            likeliest = max(legible, key=lambda it: it[1])[0]
            so_far = Exchange(likeliest, None, (), (), self._clock())
            return self._answer(Sentence(likeliest, ()), None, so_far, now)
        so_far = Exchange(text, None, (), (), self._clock())
        for move in heard.moves:
            so_far, now = self._answer_uncertain(move, text, so_far, now)
            if now.state.shared.qud:
                break
        return so_far, now

    def _answer_uncertain(
        self, move: UncertainMove, text: str, so_far: Exchange, now: Run
    ) -> TurnResult:
        """Take in a move that may be one of several, and answer it."""
        ways = tuple(reading for it in move.sentences for reading in it.readings)
        event = hear_sentences(*move.sentences, p=move.p)
        return self._answer(Sentence(text, ways), event, so_far, now)

    def _answer(
        self, sentence: Sentence, event: object, so_far: Exchange, now: Run
    ) -> TurnResult:
        """Take in one move of the tutor's, and answer it."""
        self._log.record_heard(sentence.text)
        if now.state.shared.qud and _is_yes(sentence):
            self._log.quote(_text_asked_about(now.state))
        elif now.state.shared.pending and _is_yes(sentence):
            self._log.quote_robot()
        if not sentence.readings:
            sorry = RobotSentence(
                did_not_understand(self._lexicon, sentence.text, types=self.types), None
            )
            self._log.record_said(sorry.text)
            return so_far.then(None, (), (sorry,)), now
        if any("look" in reading.content for reading in sentence.readings):
            glance, now = self._play_look("Glance", "tutor", now)
            so_far = so_far.then(None, glance.steps, ())
        answered, after = self._play(now, event)
        judged = _judge_move(sentence, answered.steps, after.model)
        self._log.record_judgement(str(judged))
        return so_far.then(judged, answered.steps, answered.said), after

    def _look_around(self) -> TurnResult:
        """Take a look unasked, in which there is no lesson yet."""
        self._log.begin_look()
        return self._play_look("Seen", "robot", self._now_at)

    def _cut_off(self, uttered: str) -> TurnResult:
        """Play that only the beginning of the latest answer was uttered."""
        latest = self._latest
        said = [] if latest is None else list(latest.said)
        left, whole = uttered.split(), 0
        for sentence in said:
            words = sentence.text.split()
            if left[: len(words)] != words:
                break
            left, whole = left[len(words) :], whole + 1
        rest = said[whole:]
        if left and (not rest or rest[0].text.split()[: len(left)] != left):
            raise UpdateError(f"{uttered[:40]!r} does not begin the latest answer")
        moves = [] if latest is None else [latest.heard]
        moves += [it.judgement for it in said[: whole + bool(left)]]
        unsaid = [it.judgement.type for it in rest if it.judgement is not None]
        if not unsaid:
            return Exchange("", None, (), (), self._clock()), self._now_at
        made = [it.sit for it in moves if it is not None]
        event = record(
            unsaid=unsaid,
            uttered=" ".join(left),
            latest=made[-1] if made else record(),
        )
        return self._play(self._now_at, event)

    def _watch(self, is_free: Callable[[], bool]) -> TurnResult:
        """Take a look while nobody speaks, and play it if something may come of it."""
        attention, state = self.gaze.attention, self.state
        before = attention.view or self.gaze.look()
        # What was pointed at is looked for like all else: it may have gone.
        self.gaze.attention = Attention(view=before)
        view = self.gaze.look()
        self._silence = self._silence.after(view.look, self._clock())
        asks = self._silence.ends_with_question(state)
        came, went = (
            missing_things(view.look, before.look),
            missing_things(before.look, view.look),
        )
        remarks = self._silence.ends_with_remark(state, bool(came or went))
        if not is_free() or not (asks or remarks):
            self.gaze.attention = attention
            return Exchange("", None, (), (), self._clock()), self._now_at
        self._log.begin_look()
        self._silence = replace(self._silence, asked=asks or self._silence.asked)
        about = {
            "came": came,
            "went": went,
            "silence": self._silence.seconds,
            "still": self._silence.still,
        }
        return self._play_view(view, about, self._now_at)

    def _play(self, now: Run, event: object) -> TurnResult:
        """Play an event, and what the robot says to it."""
        assert self.game.say is not None
        turn = self.game.take(self._update_strangers(now), event)
        said = tuple(RobotSentence(self.game.say(move), move) for move in turn.said)
        for it in said:
            self._log.record_said(it.text, str(it.judgement))
        return Exchange("", None, turn.trace, said, self._clock()), turn.run

    def _update_strangers(self, now: Run) -> Run:
        """The same, where it reckons with as many strangers as it knows of now."""
        share = self._knowledge.objects.strangers
        return now._replace(state=reckon_with_strangers(now.state, share))

    def _sentences_with_numbers(self, text: str, words: str) -> tuple[Sentence, ...]:
        """The sentences of a text in which numbers name things: "Is #2 a cup?".

        None where they only point, as in "#2 This is a cup.". A text with several that
        is not understood as a whole is not read by its parts, which have none.
        """
        if not words.strip():
            return ()
        pointing, naming = (
            understand(it, self.language, types=self.types) for it in (words, text)
        )
        if all(it.readings for it in pointing):
            return ()
        several = len(_POINTING.findall(text)) > 1
        return naming if several or all(it.readings for it in naming) else ()

    def _in_full(self, sentence: Sentence, s: Record) -> Sentence:
        """A text that only answers which thing was meant, "Red.", as a sentence."""
        return complete_answer(sentence, s, self.language, types=self.types)

    # --- seeing ----------------------------------------------------------------------

    def _play_look(self, kind: str, floor: str, now: Run) -> TurnResult:
        """Take a look, and play it as an event."""
        return self._play_view(self.gaze.look(), {"floor": floor}, now)

    def _play_view(
        self, view: NumberedLook, about: Mapping[str, object], now: Run
    ) -> TurnResult:
        """Play what is in view as an event of seeing, about which more is known."""
        self._looks += 1
        handle = f"look{self._looks}"
        self._witnesses.remember(handle, view.look, _looks_of(now.state))
        things = [
            thing_name(number) for number in range(1, len(view.look.percepts) + 1)
        ]
        places = [percept.region.place for percept in view.look.percepts]
        focus = [] if view.focus is None else [thing_name(view.focus)]
        second = [] if view.second is None else [thing_name(view.second)]
        seen = record(
            look=handle,
            things=things,
            placed=[x for x, place in zip(things, places, strict=True) if place],
            focus=focus,
            pointed=[*focus, *second] if view.pointed else [],
        )
        model = now.model.given(handle, self.types["Look"])
        for x in things:
            model = model.given(x, self.types["Ind"])
        kept = [thing_name(number) for number in view.kept]
        sights = [
            record(it._asdict(), x=x)
            for x, it in zip(things, prominences(view.look.percepts), strict=True)
        ]
        event = record(view=seen, kept=kept, sights=sights, **about)
        return self._play(now._replace(model=model), event)


def _words_shown(known: Sequence[Record]) -> Part:
    """The words that a robot knows, by their kind."""
    if not known:
        return Text("It knows no words yet.", "quiet")
    kinds: dict[str, list[str]] = {}
    for it in known:
        kinds.setdefault(str(it.kind), []).append(str(it.form))
    return Fold(
        f"it knows {count_of(len(known), 'word')}",
        table(
            ("", ""),
            kinds.items(),
            lambda it: (Text(it[0], "quiet"), name_list(it[1], "plain")),
        ),
        opened=len(known) <= SOME,
    )


def _open_memory(memory: Memory | Path | str | None) -> Memory:
    match memory:
        case None:
            return Memory.transient()
        case Memory():
            return memory
    return Memory.open(Path(memory))


def _cause(error: BaseException) -> SensorError | MemoryFileError | None:
    """The failure of sensor or memory because of which a move of the game failed."""
    cause = error.__cause__ if isinstance(error, TTRError) else None
    while cause is not None:
        if isinstance(cause, SensorError | MemoryFileError):
            return cause
        cause = cause.__cause__
    return None


def _judge_move(sentence: Sentence, steps: Sequence[Step], model: Model) -> Judgement:
    """The move that a sentence was taken to be, as a judgement.

    An answer to a question of the robot's may make another move the latest one.
    """
    taken = [it.after.shared.latest for it in steps if it.after.shared.latest]
    judged = (
        model.judge(move, set_to(reading.type, content=RecType @ move.content))
        for move in reversed(taken)
        if move.spkr == TUTOR
        for reading in sentence.readings
    )
    return next(it for it in judged if it.p == CERTAIN)


def _is_yes(sentence: Sentence) -> bool:
    """Whether a sentence is a yes, as an answer to a question."""
    moves = (predicate_at(it.type, "e").name for it in sentence.readings[:1])
    return "affirm" in moves


def _text_asked_about(s: Record) -> str:
    """What the tutor said of which the robot has asked whether it is meant so."""
    options = s.shared.qud[0].options
    said = options[0] if options else record()
    return str(said.text) if "text" in said else ""


def _looks_of(s: Record) -> set[str]:
    """The looks about which the tutor may still confirm or correct something."""
    open_ = [option.content for issue in s.shared.qud for option in issue.options]
    taught = [it.content for it in s.private.lessons[-1:]]
    looks = [it.get("look") for it in (*s.shared.pending, *open_, *taught)]
    return {str(look.value) for look in looks if isinstance(look, Singleton)}


def _check_probable(texts: Sequence[tuple[str, float]]) -> None:
    if not texts:
        raise UpdateError("nothing was perhaps said: give texts and probabilities")
    for text, p in texts:
        if not 0 < p <= 1:
            raise UpdateError(
                f"what was perhaps said has a probability above 0 and at most 1, but "
                f"{text[:40]!r} has {p}"
            )


def _decimal(p: float) -> str:
    """A probability to its last digit, without an exponent."""
    return format(Decimal(repr(float(p))), "f")


def _legible(text: str) -> str:
    """The text without halves of surrogate pairs, which no file can keep."""
    return text.encode("utf-8", "replace").decode("utf-8")
