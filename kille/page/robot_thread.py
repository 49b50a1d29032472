"""The robot in a thread of its own, in which its turns are taken one after another.

What it does it tells as events. A turn is told when it is over, and what was learned in
it is on disk.

| event | has |
| --- | --- |
| `heard` | what the tutor has said or done, before the robot answers: `says`, `ref`; \
if it was spoken, `perhaps`: texts with their probabilities; `arranges`, if it is a \
change of the scene |
| `turn` | the turn, as `turn_report` has it; `ms`, how long it took; `ref`; `turns`, \
the numbers of its exchanges, to look inside |
| `view` | what is in view after it, as `view_report` has it; `glimpsed`, if no turn \
was taken, but something has moved |
| `table` | how the scene can be arranged by hand, as `table_report` has it, whenever \
that has changed |
| `pointed` | what the tutor points at now: `thing` or `box`; `as`: `that` for a \
second thing, beside the one before; `ref` |
| `uttered` | how much of an answer was uttered before it was cut off: `turn`, its \
number, `text`; `whole`, whether it was all of it |
| `failed` | why nothing came of it: `text`, `ref`; `seen`, whether it is the camera |
| `microphone` | who has the microphone: `browser`, its number, 0 for nobody; `who` |
| `stepping` | whether turns wait before each rule: `on` |
| `step` | before which the turn waits now: `rule`, what it `does`, its `changes` |
| `beside` | what came of it for the second robot, if there is one: `said`, `lessons`, \
`names` of the things in view, `turns`, `ref`; `failed`, why it took no turn |
| `camera` | what is wrong with the camera: `text`, empty when it is well again |
| `restarted` | a new dialogue has begun |
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from math import inf
from threading import Lock
from time import monotonic, perf_counter
from typing import NamedTuple, TypeVar

from kille.agent.agent import Agent
from kille.agent.exchanges import Event
from kille.agent.spoken_turns import is_understood
from kille.memory import MemoryFileError
from kille.page.browser_requests import BrowserRequest
from kille.page.feed import Feed
from kille.page.history import History
from kille.page.second_robot import MakeSecond, SecondRobot
from kille.page.state_changes import PLAIN, Insight, Json
from kille.page.stepping import Stepper
from kille.page.table import table_report
from kille.page.turn_reports import turn_report, view_report
from kille.scene import Box
from kille.sensors.sensor import SensorError
from ttr import TTRError
from ttr.escapes import terminal_text
from ttr.updates import Game

T = TypeVar("T")


class Watch(NamedTuple):
    """What watches a robot, as it is made: it is given every event after it has
    happened, and the game that it plays instead of its own waits when it is asked to.
    """

    record_event: Callable[[Event], None]
    stepper: Stepper

    def change(self, game: Game) -> Game:
        """The game whose steps are watched."""
        return replace(game, watch=self.stepper)


WAITING = 8
"""How many requests may wait for their turn; more are refused."""

READING = 32
"""How many may wait to look into the robot; more are refused."""

_PAUSE, _LONGEST_PAUSE = 0.2, 10.0
"""Seconds after a glimpse before the next; longer each time nothing has moved."""

_STILL = 4
"""Pixels by which the box of a thing differs from look to look."""

_GLIMPSE = BrowserRequest("", "", lambda robot: robot.do("glimpse"))

_KNOWN = 1_000
"""How many requests are remembered, so that none is done twice."""


class BusyError(Exception):
    """So many requests wait that no more are taken."""


class RobotThread:
    """A robot whose turns are serialised, and told to a feed.

    `tell` is given what goes wrong with the camera or the memory, and an empty text
    when that is over; `report` what nobody foresaw. `make_second` makes a robot that
    stands beside it.
    """

    def __init__(
        self,
        make: Callable[[Watch], Agent],
        feed: Feed,
        tell: Callable[[str], object] = lambda _: None,
        report: Callable[[Exception], object] = lambda _: None,
        insight: Insight = PLAIN,
        make_second: MakeSecond | None = None,
    ) -> None:
        self.second: SecondRobot | None = None
        self.insight, self.history = insight, History()
        self.stepper = Stepper(feed.publish, insight)
        self._feed, self._tell, self._report = feed, tell, report
        self._turns = 0  # exchanges before the request that is done now
        self._counting, self._waiting, self._closed = Lock(), 0, False
        self._thread = ThreadPoolExecutor(1, "kille-robot")
        try:
            watch = Watch(self._keep_event, self.stepper)
            self.robot = self._thread.submit(make, watch).result()
            if make_second is not None:
                self.second = self._thread.submit(
                    self._wake_second, make_second
                ).result()
        except BaseException:
            self._thread.shutdown()
            raise
        self.began = self.robot.time
        self._trouble = ""
        self._table: Json = {}
        self._known: deque[str] = deque(maxlen=_KNOWN)
        self._asked: deque[BrowserRequest] = deque()
        self._pause, self._may_glimpse = _PAUSE, 0.0
        self._reads: deque[Callable[[], None]] = deque()
        self._cut: BrowserRequest | None = None  # an answer that was not all uttered

    def ask(self, request: BrowserRequest) -> None:
        """Have a request done when it is its turn. BusyError if too many wait.

        One that is asked for again, by the same `ref`, is done once: a browser asks
        again for what was not answered when its connection went.
        """
        if request.steps:  # it is about the turn that is taken now
            self.stepper.ask(request.steps)
            return
        with self._counting:
            if request.ref and request.ref in self._known:
                return
            if self._waiting >= WAITING:
                raise BusyError("too much waits to be answered: say it again later")
            self._waiting += 1
            self._known.append(request.ref)
            self._asked.append(request)
        self._thread.submit(self._do_next)

    def read(self, work: Callable[[Agent], T]) -> Future[T]:
        """What is worked out of the robot, and changes nothing in it. BusyError if too
        much of it waits.

        It is done when no request waits: the types of a robot are one thread's, and
        whoever looks inside keeps nobody waiting who speaks.
        """
        found: Future[T] = Future()

        def find() -> None:
            if not found.set_running_or_notify_cancel():
                return
            try:
                found.set_result(work(self.robot))
            except BaseException as error:
                found.set_exception(error)

        with self._counting:
            if len(self._reads) >= READING:
                raise BusyError("too many look inside at this moment: try again later")
            self._reads.append(find)
        self._thread.submit(self._do_next)
        return found

    def attend(self, is_another: bool) -> None:
        """Have it look, without a turn, if the scene is another than at its latest look
        and nothing else is to be done.

        Where that goes on and nothing has moved, it does so less and less often.
        """
        with self._counting:
            if not is_another:
                self._pause = _PAUSE
                return
            if self._waiting or self._asked or monotonic() < self._may_glimpse:
                return
            self._may_glimpse = inf
            self._asked.append(_GLIMPSE)
        self._thread.submit(self._do_next)

    def _glimpse(self) -> None:
        before = _boxes(self.robot)
        try:
            if not self._closed:
                _GLIMPSE.act(self.robot)
                if self.second is not None:
                    self.second.follow(self._turns)
                report = view_report(self.robot)
                about = {"type": "view", "ref": "", "glimpsed": True}
                self._feed.publish({**about, **report}, about)
        except (SensorError, TTRError):
            pass  # the picture tells of the camera
        except Exception as error:
            self._report(error)
        finally:
            is_still = _is_still(before, _boxes(self.robot))
            pause = self._pause * 2 if is_still else _PAUSE
            self._pause = min(pause, _LONGEST_PAUSE)
            self._may_glimpse = monotonic() + self._pause

    def _do_next(self) -> None:
        """Do what has waited longest: a request, or else a look inside."""
        with self._counting:
            request = self._asked.popleft() if self._asked else None
            find = None if request is not None else self._reads.popleft()
        if request is _GLIMPSE:
            self._glimpse()
        elif request is not None:
            self._do(request)
        elif find is not None:
            find()

    def _wake_second(self, make: MakeSecond) -> SecondRobot:
        try:
            return SecondRobot(make, self.robot)
        except BaseException:
            self.robot.close()
            raise

    def _keep_event(self, event: Event) -> None:
        self.history.keep_event(event, self._turns)
        if self.second is not None:
            self.second.note(event)

    def close(self) -> None:
        """End the turn that is taken now, drop those that wait, and let go of all."""
        self._closed = True
        self.stepper.ask("off")
        ended = self._thread.submit(self._close_robots)
        self._thread.shutdown()
        ended.result()

    def _close_robots(self) -> None:
        with closing(self.robot):
            if self.second is not None:
                self.second.close()

    def _do(self, request: BrowserRequest) -> None:
        try:
            if not self._closed:
                self._take_turn(request)
        except Exception as error:
            self._report(error)
            self._fail(request, "something went wrong that nobody foresaw")
        try:
            self._follow(request)
        except Exception as error:
            self._report(error)
        finally:
            with self._counting:
                self._waiting -= 1

    def _take_turn(self, request: BrowserRequest) -> None:
        robot = self.robot
        if request.uttered:
            self._take_uttered(request)
            return
        self._take_interruption(request)
        if request.shown:
            perhaps = [[it.text, round(it.p, 3)] for it in request.perhaps]
            about = {"perhaps": perhaps} if request.perhaps else {}
            arranges = {"arranges": True} if request.arranges else {}
            says = terminal_text(request.shown)
            self._publish("heard", request, says=says, **about, **arranges)
        turns, began = len(robot.exchanges), perf_counter()
        self._turns = turns
        self.stepper.begin_turn()
        try:
            if request.restarts:
                robot.do("restart")
                turns = len(robot.exchanges)
                self._publish("restarted", request)
            answer = request.act(robot)
        except (SensorError, MemoryFileError, TTRError) as error:
            if not request.arranges and request.pointed is None:
                self._tell_trouble(str(error))
            self._fail(request, str(error), seen=isinstance(error, SensorError))
            self._tell_of_table(request, again=request.arranges)
            return
        self._tell_trouble("")
        took = round((perf_counter() - began - self.stepper.waited) * 1000)
        if request.pointed is not None:
            self._publish("pointed", request, **request.pointed)
            return
        report = turn_report(robot, robot.exchanges[turns:])
        report["said"] = report["said"] or answer
        taken = [turns, len(robot.exchanges)]
        if robot.view is not None and taken[0] < taken[1]:
            self.history.keep_picture(turns, robot.view.look.frame.colour)
        self._publish("turn", request, ms=took, turns=taken, **report)
        self._publish("view", request, **view_report(robot))
        self._tell_of_table(request)

    def _follow(self, request: BrowserRequest) -> None:
        """Have the second robot live through what has happened to the first."""
        if self.second is None or self._closed:
            return
        taken = [self._turns, len(self.robot.exchanges)]
        if report := self.second.follow(self._turns):
            self._publish("beside", request, turns=taken, **report)

    def _tell_of_table(self, request: BrowserRequest, again: bool = False) -> None:
        """Tell how the scene is arranged, if that is new, or not as somebody wanted."""
        table = table_report(self.robot.gaze.sensor)
        if again or table != self._table:
            self._table = table
            self._publish("table", request, **table)

    def _take_uttered(self, request: BrowserRequest) -> None:
        """Tell how much of an answer was uttered. If not all of it was, the robot was
        interrupted, unless what was said over it is not understood."""
        if is_cut := request.cuts(self.robot):
            self._cut = request
        else:
            request.act(self.robot)
        about = {"turn": request.uttered, "text": request.shown, "whole": not is_cut}
        self._publish("uttered", request, **about)

    def _take_interruption(self, request: BrowserRequest) -> None:
        """Let what was cut off be unsaid, if this request is what interrupted it."""
        cut = self._cut
        if cut is None or request.pointed is not None:
            return
        self._cut = None
        if request.says and not is_understood(self.robot, request.says):
            return
        turns = len(self.robot.exchanges)
        cut.act(self.robot)
        taken = [turns, len(self.robot.exchanges)]
        report = turn_report(self.robot, self.robot.exchanges[turns:])
        self._publish("turn", cut, ms=0, turns=taken, **report)

    def _publish(self, kind: str, request: BrowserRequest, **about: object) -> None:
        self._feed.publish({"type": kind, "ref": request.ref, **about})

    def _fail(self, request: BrowserRequest, why: str, seen: bool = False) -> None:
        self._publish("failed", request, text=why, seen=seen)

    def _tell_trouble(self, trouble: str) -> None:
        """Tell once of trouble that comes again with every request, and of its end."""
        if trouble != self._trouble:
            self._trouble = trouble
            self._tell(trouble)


def _boxes(robot: Agent) -> list[Box]:
    """Where the things in view are."""
    return (
        [] if robot.view is None else [it.region.box for it in robot.view.look.percepts]
    )


def _is_still(before: list[Box], after: list[Box]) -> bool:
    """Whether things are where they were."""
    return len(before) == len(after) and all(
        abs(one - other) <= _STILL
        for boxes in zip(before, after, strict=True)
        for one, other in zip(*boxes, strict=True)
    )
