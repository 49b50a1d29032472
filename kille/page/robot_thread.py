"""The robot in a thread of its own, in which its turns are taken one after another.

What it does it tells as events. A turn is told when it is over, and what was learned in
it is on disk.

| event | has |
| --- | --- |
| `heard` | what the tutor has said or done, before the robot answers: `says`, `ref` |
| `turn` | the turn, as `turn_report` has it; `ms`, how long it took; `ref`; `turns`, \
the numbers of its exchanges, to look inside |
| `view` | what is in view after it, as `view_report` has it |
| `table` | how the scene can be arranged by hand, as `table_report` has it, whenever \
that has changed |
| `pointed` | what the tutor points at now: `thing` or `box`; `as`: `that` for a \
second thing, beside the one before; `ref` |
| `failed` | why nothing came of it: `text`, `ref` |
| `camera` | what is wrong with the camera: `text`, empty when it is well again |
| `restarted` | a new dialogue has begun |
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from threading import Lock
from time import perf_counter
from typing import TypeVar

from kille.agent.agent import Agent
from kille.agent.exchanges import Event
from kille.memory import MemoryFileError
from kille.page.browser_requests import BrowserRequest
from kille.page.feed import Feed
from kille.page.history import History
from kille.page.inside import PLAIN, Insight, Json
from kille.page.table import table_report
from kille.page.turn_reports import turn_report, view_report
from kille.sensors.sensor import SensorError
from ttr import TTRError

T = TypeVar("T")

RecordEvent = Callable[[Event], None]

WAITING = 8
"""How many requests may wait for their turn; more are refused."""


class BusyError(Exception):
    """So many requests wait that no more are taken."""


class RobotThread:
    """A robot whose turns are serialised, and told to a feed.

    `tell` is given what goes wrong, for the terminal; `report` what nobody foresaw.
    """

    def __init__(
        self,
        make: Callable[[RecordEvent], Agent],
        feed: Feed,
        tell: Callable[[str], object] = lambda _: None,
        report: Callable[[Exception], object] = lambda _: None,
        insight: Insight = PLAIN,
    ) -> None:
        self.insight, self.history = insight, History()
        self._feed, self._tell, self._report = feed, tell, report
        self._turns = 0  # exchanges before the request that is done now
        self._counting, self._waiting, self._closed = Lock(), 0, False
        self._thread = ThreadPoolExecutor(1, "kille-robot")
        try:
            self.robot = self._thread.submit(make, self._keep_event).result()
        except BaseException:
            self._thread.shutdown()
            raise
        self.began = self.robot.time
        self._trouble = ""
        self._table: Json = {}

    def ask(self, request: BrowserRequest) -> None:
        """Have a request done when it is its turn. BusyError if too many wait."""
        with self._counting:
            if self._waiting >= WAITING:
                raise BusyError("too much waits to be answered: say it again later")
            self._waiting += 1
        self._thread.submit(self._do, request)

    def read(self, work: Callable[[Agent], T]) -> Future[T]:
        """What is worked out of the robot, and changes nothing in it.

        It is done when it is its turn: the types of a robot are one thread's.
        """
        return self._thread.submit(lambda: work(self.robot))

    def _keep_event(self, event: Event) -> None:
        self.history.keep_event(event, self._turns)

    def close(self) -> None:
        """End the turn that is taken now, drop those that wait, and let go of all."""
        self._closed = True
        closing = self._thread.submit(self.robot.close)
        self._thread.shutdown()
        closing.result()

    def _do(self, request: BrowserRequest) -> None:
        try:
            if not self._closed:
                self._take_turn(request)
        except Exception as error:
            self._report(error)
            self._fail(request, "something went wrong that nobody foresaw")
        finally:
            with self._counting:
                self._waiting -= 1

    def _take_turn(self, request: BrowserRequest) -> None:
        robot = self.robot
        if request.shown:
            self._publish("heard", request, says=request.shown)
        turns, began = len(robot.exchanges), perf_counter()
        self._turns = turns
        try:
            request.act(robot)
        except (SensorError, MemoryFileError, TTRError) as error:
            if not request.arranges and request.pointed is None:
                self._tell_trouble(str(error))
            self._fail(request, str(error))
            self._tell_of_table(request, again=request.arranges)
            return
        self._tell_trouble("")
        took = round((perf_counter() - began) * 1000)
        if request.pointed is not None:
            self._publish("pointed", request, **request.pointed)
            return
        if request.restarts:
            self._publish("restarted", request)
        report = turn_report(robot, robot.exchanges[turns:])
        taken = [turns, len(robot.exchanges)]
        if robot.view is not None and taken[0] < taken[1]:
            self.history.keep_picture(turns, robot.view.look.frame.colour)
        self._publish("turn", request, ms=took, turns=taken, **report)
        self._publish("view", request, **view_report(robot))
        self._tell_of_table(request)

    def _tell_of_table(self, request: BrowserRequest, again: bool = False) -> None:
        """Tell how the scene is arranged, if that is new, or not as somebody wanted."""
        table = table_report(self.robot.gaze.sensor)
        if again or table != self._table:
            self._table = table
            self._publish("table", request, **table)

    def _publish(self, kind: str, request: BrowserRequest, **about: object) -> None:
        self._feed.publish({"type": kind, "ref": request.ref, **about})

    def _fail(self, request: BrowserRequest, why: str) -> None:
        self._publish("failed", request, text=why)

    def _tell_trouble(self, trouble: str) -> None:
        """Tell the terminal once of trouble that comes again with every request."""
        if trouble and trouble != self._trouble:
            self._tell(trouble)
        self._trouble = trouble
