"""Questions and answers: two topics, and numbers that pair them.

So questions can be watched and recorded like everything on the bus, and may hold
anything. A question without an answer is asked again under its number, as the answering
side may have started late or anew; it never does anything twice.
"""

from __future__ import annotations

import logging
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import count, islice
from queue import Empty, SimpleQueue
from threading import Lock
from typing import Any, Generic, TypeVar
from uuid import uuid4

from kille.bus.interface import Bus, Publisher, Subscription
from kille.bus.messages import Bundle, BusError, Facts, Topic

_logger = logging.getLogger("kille.bus")

A = TypeVar("A", bound=Facts | Bundle)

_FAULT = "who answers failed, by a fault of its own; its log says why"

_SOON = 0.01
"""Seconds between two looks whether anybody listens."""

_AGAIN = 1.0
"""Seconds after which a question is asked again."""

_KEPT = 4
"""How many answers are kept, for questions that are asked again."""

_DONE = 1000
"""How many questions are remembered as answered."""


@dataclass(frozen=True)
class Service(Generic[A]):
    """Two topics, for questions and answers; `who` is the command that answers.

    >>> sums = Service(Topic("asked", Facts), Topic("told", Facts), "a calculator")
    >>> sums.questions.name
    'asked'
    """

    questions: Topic[Facts]
    answers: Topic[A]
    who: str


def serve(
    bus: Bus, service: Service[A], answer: Callable[[Mapping[str, Any]], A]
) -> Subscription:
    """Answer all questions.

    `answer` raises BusError for a wrong question, and the asker gets its message. Any
    other error is logged here, and the asker learns that the question failed.

    >>> from kille.bus import Asking, LocalBus
    >>> bus = LocalBus()
    >>> sums = Service(Topic("asked", Facts), Topic("told", Facts), "a calculator")
    >>> serving = serve(bus, sums, lambda asked: Facts({"sum": sum(asked["of"])}))
    >>> Asking(bus, sums, patience=5).ask({"of": [2, 3]})["sum"]
    5
    >>> bus.close()
    """
    return _Serving(bus, service, answer)


class _Serving(Generic[A]):
    """Answers the questions of a service."""

    def __init__(
        self,
        bus: Bus,
        service: Service[A],
        answer: Callable[[Mapping[str, Any]], A],
    ) -> None:
        self._answer, self._kind = answer, service.answers.kind
        self._name = service.questions.name.lstrip("/")
        self._given: OrderedDict[str, A | None] = OrderedDict()
        self._answers: Publisher[A] = bus.publisher(service.answers)
        self._questions = bus.subscribe(service.questions, self._take)

    @property
    def trouble(self) -> str:
        """Why the latest question could not be read."""
        return self._questions.trouble

    def close(self) -> None:
        """Answer no more."""
        self._questions.close()
        self._answers.close()

    def _take(self, question: Facts) -> None:
        number = str(question.facts.get("id", ""))
        if number not in self._given:
            given = self._compute_answer(question.facts)
            self._keep(number, replace(given, facts={**given.facts, "id": number}))
        answer = self._given[number]
        # A question that waited while many others were answered has its answer.
        if answer is not None:
            self._answers.publish(answer)
        # Who gives no number cannot ask the same again.
        self._given.pop("", None)

    def _keep(self, number: str, answer: A) -> None:
        """Keep an answer; of older ones, keep only that they were given."""
        self._given[number] = answer
        for old in islice(reversed(self._given), _KEPT, _KEPT + 1):
            self._given[old] = None
        while len(self._given) > _DONE:
            self._given.popitem(last=False)

    def _compute_answer(self, question: Mapping[str, Any]) -> A:
        try:
            return self._answer(question)
        except BusError as error:
            return self._kind({"error": str(error)})
        except Exception:
            _logger.exception("answering /%s", self._name)
            return self._kind({"error": f"/{self._name}: {_FAULT}"})


class Asking(Generic[A]):
    """Asks the questions of a service, one after the other.

    >>> from kille.bus.local import LocalBus
    >>> bus = LocalBus()
    >>> asked, told = Topic("sums/asked", Facts), Topic("sums/told", Facts)
    >>> sums = Service(asked, told, "nothing")
    >>> serving = serve(bus, sums, lambda asked: Facts({"sum": sum(asked["of"])}))
    >>> Asking(bus, sums, patience=5).ask({"of": [2, 3]})["sum"]
    5
    >>> bus.close()
    """

    def __init__(self, bus: Bus, service: Service[A], patience: float) -> None:
        """`patience` is how many seconds one waits for an answer."""
        self._service, self._patience = service, patience
        self._lock = Lock()
        self._numbers = (f"{uuid4().hex[:8]}-{n}" for n in count(1))
        self._heard: SimpleQueue[A] = SimpleQueue()
        self._number = ""
        self._answers = bus.subscribe(service.answers, self._take)
        self._questions: Publisher[Facts] = bus.publisher(service.questions)

    def ask(self, question: Mapping[str, Any]) -> Mapping[str, Any]:
        """The facts of the answer; BusError if there is none, or it is an error."""
        return self.request(question).facts

    def request(self, question: Mapping[str, Any]) -> A:
        """The answer; BusError if there is none, or it is an error."""
        with self._lock:
            self._number = next(self._numbers)
            answer = self._wait_for_answer(Facts({**question, "id": self._number}))
        if "error" in answer.facts:
            raise BusError(str(answer.facts["error"]))
        return answer

    def close(self) -> None:
        """Ask no more."""
        self._answers.close()
        self._questions.close()

    def _wait_for_answer(self, question: Facts) -> A:
        end = time.monotonic() + self._patience
        while not self._questions.listeners and time.monotonic() < end:
            time.sleep(_SOON)
        while (left := end - time.monotonic()) > 0:
            self._questions.publish(question)
            answer = self._next(min(left, _AGAIN))
            if answer is not None:
                return answer
        raise BusError(
            f"nobody answered on {self._service.questions.name} within "
            f"{self._patience:g} s: is `{self._service.who}` running?"
        )

    def _next(self, seconds: float) -> A | None:
        """The answer to the present question; late answers to others are skipped."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            try:
                answer = self._heard.get(timeout=left)
            except Empty:
                return None
            if answer.facts["id"] == self._number:
                return answer
        return None

    def _take(self, answer: A) -> None:
        if answer.facts.get("id") == self._number:
            self._heard.put(answer)
