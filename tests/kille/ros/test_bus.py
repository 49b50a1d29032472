"""What every bus keeps to, within a process and over ROS."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import astuple
from itertools import count
from typing import Any

import numpy as np
import pytest

from kille.bus import (
    Asking,
    Bundle,
    Bus,
    BusError,
    Camera,
    Facts,
    Image,
    LocalBus,
    Service,
    Text,
    Topic,
    serve,
)

NUMBERS = count(1)

PATIENCE = 60.0
"""Seconds in which an answer comes, on the slowest machine."""

Eventually = Callable[..., Any]


def fresh(kind: type[Any], **how: Any) -> Topic[Any]:
    """A topic that nobody has used."""
    return Topic(f"tests/topic{next(NUMBERS)}", kind, **how)


def connected(bus: Bus, topic: Topic[Any], eventually: Eventually) -> Any:
    """A publisher to which somebody listens."""
    publisher = bus.publisher(topic)
    eventually(lambda: publisher.listeners)
    return publisher


RNG = np.random.default_rng(0)
MESSAGES = [
    Text("Är det en röd kopp? \N{GRINNING FACE} \n #2"),
    Text(""),
    Facts({"a": [1, 2.5, None, True], "b": {"c": "å"}}),
    Image(RNG.integers(0, 255, (48, 64, 3), np.uint8), 1_700_000_000_123_456_789),
    Image(np.array([[0.5, np.nan], [1e-3, 4.0]], np.float32), 7),
    Image(RNG.integers(0, 5000, (5, 3), np.uint16), 0),
    Image(RNG.integers(0, 255, (5, 3), np.uint8), 1),
    Camera(525.0, 524.5, 319.5, 239.5, 640, 480, 12),
    Bundle({"id": "é"}, {"a": np.zeros((0, 128), np.uint8), "b_c": np.arange(3.0)}),
    Bundle({}),
]


def same(sent: Any, received: Any) -> None:
    assert type(received) is type(sent)
    match sent:
        case Image():
            assert received.stamp == sent.stamp
            assert received.pixels.dtype == sent.pixels.dtype
            np.testing.assert_array_equal(received.pixels, sent.pixels)
        case Bundle():
            assert received.facts == sent.facts
            assert received.arrays.keys() == sent.arrays.keys()
            for name, array in sent.arrays.items():
                assert received.arrays[name].dtype == array.dtype
                np.testing.assert_array_equal(received.arrays[name], array)
        case _:
            assert received == sent


def test_what_is_sent_comes_as_it_was(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    for message in MESSAGES:
        topic = fresh(type(message))
        listening = heard(bus, topic)
        connected(bus, topic, eventually).publish(message)
        same(message, listening.next())


def test_what_comes_cannot_be_changed(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    topic = fresh(Image)
    listening = heard(bus, topic)
    connected(bus, topic, eventually).publish(Image(np.ones((2, 2), np.uint8), 0))
    image = listening.next()
    with pytest.raises(ValueError, match="read-only"):
        image.pixels[0, 0] = 9
    with pytest.raises(AttributeError):
        image.stamp = 9


def test_messages_come_in_order_to_all_who_listen(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    topic = fresh(Text)
    both = heard(bus, topic), heard(bus, topic)
    publisher = connected(bus, topic, eventually)
    for number in range(50):
        publisher.publish(Text(str(number)))
    for one in both:
        assert [one.next().text for _ in range(50)] == list(map(str, range(50)))


def test_who_comes_late_gets_the_latest_of_a_latched_topic(
    bus: Bus, heard: Any
) -> None:
    latched, other = fresh(Text, latched=True), fresh(Text)
    publishers = bus.publisher(latched), bus.publisher(other)
    for publisher in publishers:
        publisher.publish(Text("before"))
        publisher.publish(Text("now"))
    assert heard(bus, latched).next() == Text("now")
    assert heard(bus, other).nothing()


def test_who_has_stopped_listening_gets_nothing(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    topic = fresh(Text)
    one, other = heard(bus, topic), heard(bus, topic)
    publisher = connected(bus, topic, eventually)
    one.listening.close()
    one.listening.close()
    publisher.publish(Text("anybody?"))
    assert other.next() == Text("anybody?")
    assert one.nothing()


def test_what_is_sent_just_before_the_end_comes(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    for _ in range(10):
        topic = fresh(Text)
        listening = heard(bus, topic)
        publisher = connected(bus, topic, eventually)
        publisher.publish(Text("Goodbye."))
        publisher.close()
        assert listening.next(10) == Text("Goodbye.")


def test_who_is_busy_hears_what_was_sent_by_who_has_gone_since(
    bus: Bus, eventually: Eventually
) -> None:
    topic, go, heard = fresh(Text), threading.Event(), list[str]()

    def take(message: Text) -> None:
        heard.append(message.text)
        assert go.wait(PATIENCE)

    bus.subscribe(topic, take)
    publisher = connected(bus, topic, eventually)

    def send() -> None:
        publisher.publish(Text("I go."))
        eventually(lambda: heard)
        publisher.publish(Text("Goodbye."))
        publisher.close()
        go.set()

    sender = threading.Thread(target=send)
    sender.start()
    try:
        if isinstance(bus, LocalBus):
            go.set()  # who sends waits until it is taken
        eventually(lambda: heard == ["I go.", "Goodbye."])
    finally:
        go.set()
        sender.join()


def test_to_stop_listening_waits_for_what_is_being_taken(
    bus: Bus, eventually: Eventually
) -> None:
    topic, begun, go, done = fresh(Text), *(threading.Event() for _ in range(3))

    def take(message: Text) -> None:
        begun.set()
        go.wait(PATIENCE)
        done.set()

    listening = bus.subscribe(topic, take)
    connected(bus, topic, eventually).publish(Text(""))
    assert begun.wait(PATIENCE)
    later = threading.Timer(0.1, go.set)
    later.start()
    listening.close()
    assert done.is_set()
    later.join()


def test_who_listens_may_itself_stop(bus: Bus, eventually: Eventually) -> None:
    topic, taken = fresh(Text), list[str]()
    stopped = threading.Event()

    def take(message: Text) -> None:
        taken.append(message.text)
        listening.close()
        stopped.set()

    listening = bus.subscribe(topic, take)
    publisher = connected(bus, topic, eventually)
    publisher.publish(Text("first"))
    publisher.publish(Text("second"))
    assert stopped.wait(PATIENCE)
    assert taken == ["first"]


def test_who_has_stopped_sending_sends_nothing(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    topic = fresh(Text)
    listening = heard(bus, topic)
    publisher = connected(bus, topic, eventually)
    publisher.close()
    publisher.close()
    publisher.publish(Text("anybody?"))
    assert listening.nothing()


def test_an_error_of_a_listener_is_logged_and_the_next_message_is_taken(
    bus: Bus, eventually: Eventually, caplog: pytest.LogCaptureFixture
) -> None:
    topic, taken = fresh(Text), list[str]()

    def take(message: Text) -> None:
        taken.append(message.text)
        if message.text == "bad":
            raise ZeroDivisionError

    bus.subscribe(topic, take)
    publisher = connected(bus, topic, eventually)
    with caplog.at_level(logging.ERROR, "kille.bus"):
        publisher.publish(Text("bad"))
        publisher.publish(Text("good"))
        eventually(lambda: "good" in taken)
    assert topic.name in caplog.text
    assert "ZeroDivisionError" in caplog.text


def test_a_slow_listener_loses_the_oldest_and_never_the_latest(
    bus: Bus, eventually: Eventually
) -> None:
    topic, taken, go = fresh(Text, waiting=3), list[int](), threading.Event()

    def take(message: Text) -> None:
        go.wait(PATIENCE)
        taken.append(int(message.text))

    bus.subscribe(topic, take)
    publisher = connected(bus, topic, eventually)
    for number in range(200):
        publisher.publish(Text(str(number)))
    go.set()
    eventually(lambda: taken[-1:] == [199])
    assert taken == sorted(set(taken))


def test_a_listener_takes_one_message_at_a_time(
    bus: Bus, eventually: Eventually
) -> None:
    topic, inside, taken = fresh(Text), threading.Semaphore(1), list[bool]()

    def take(message: Text) -> None:
        alone = inside.acquire(blocking=False)
        threading.Event().wait(0.005)
        if alone:
            inside.release()
        taken.append(alone)

    bus.subscribe(topic, take)
    publishers = [connected(bus, topic, eventually) for _ in range(2)]
    for _ in range(5):
        for publisher in publishers:
            publisher.publish(Text(""))
    eventually(lambda: len(taken) == 10)
    assert all(taken)


def test_a_listener_may_itself_send(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    asked, told = fresh(Text), fresh(Text)
    listening = heard(bus, told)
    echo = connected(bus, told, eventually)
    bus.subscribe(asked, echo.publish)
    connected(bus, asked, eventually).publish(Text("echo"))
    assert listening.next() == Text("echo")


def test_a_topic_has_one_kind_of_messages(bus: Bus) -> None:
    topic = fresh(Text)
    bus.subscribe(topic, lambda message: None)
    with pytest.raises(BusError, match=topic.name):
        bus.publisher(Topic(topic.name, Image))


def test_nothing_is_taken_after_the_bus_is_closed(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    topic = fresh(Text)
    listening = heard(bus, topic)
    publisher = connected(bus, topic, eventually)
    bus.close()
    bus.close()
    publisher.publish(Text("anybody?"))
    assert listening.nothing()


# --- questions -----------------------------------------------------------------------


def service(kind: type[Any] = Facts) -> Service[Any]:
    return Service(fresh(Facts), fresh(kind), "kille something")


def test_a_question_gets_its_answer(bus: Bus) -> None:
    sums = service()
    serve(bus, sums, lambda asked: Facts({"sum": sum(asked["of"])}))
    asking = Asking(bus, sums, PATIENCE)
    for numbers in ([2, 3], [], [1.5]):
        assert asking.ask({"of": numbers})["sum"] == sum(numbers)


def test_many_who_ask_get_each_their_own(bus: Bus) -> None:
    doubling = service(Bundle)
    serve(bus, doubling, lambda asked: Bundle({}, {"n": np.array(2 * asked["n"])}))
    askers = [Asking(bus, doubling, PATIENCE) for _ in range(4)]
    found = dict[int, int]()

    def ask(number: int) -> None:
        found[number] = int(askers[number].request({"n": number}).arrays["n"])

    threads = [threading.Thread(target=ask, args=(n,)) for n in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == {0: 0, 1: 2, 2: 4, 3: 6}


def test_what_is_wrong_with_a_question_comes_to_who_asked(bus: Bus) -> None:
    def answer(asked: Any) -> Facts:
        raise BusError(f"{asked['n']} is too much")

    refusing = service()
    serve(bus, refusing, answer)
    with pytest.raises(BusError, match=r"^7 is too much$"):
        Asking(bus, refusing, PATIENCE).ask({"n": 7})


def test_a_fault_of_who_answers_is_logged_and_told_to_who_asked(
    bus: Bus, caplog: pytest.LogCaptureFixture
) -> None:
    def answer(asked: Any) -> Facts:
        raise ZeroDivisionError

    failing = service()
    serve(bus, failing, answer)
    with pytest.raises(BusError, match="its log says why"):
        Asking(bus, failing, PATIENCE).ask({})
    assert "ZeroDivisionError" in caplog.text


def test_a_question_that_nobody_answers_says_who_should(bus: Bus) -> None:
    silent = service()
    with pytest.raises(BusError, match=r"within 0\.2 s: is `kille something` running"):
        Asking(bus, silent, 0.2).ask({})


def test_a_question_asked_again_is_answered_but_done_once(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    counting, done = service(), list[Any]()

    def answer(asked: Any) -> Facts:
        done.append(asked)
        return Facts({})

    serve(bus, counting, answer)
    answers = heard(bus, counting.answers)
    asking = connected(bus, counting.questions, eventually)
    eventually(lambda: bus.publisher(counting.answers).listeners)
    for _ in range(2):
        asking.publish(Facts({"id": "q1"}))
    assert [answers.next(), answers.next()] == [Facts({"id": "q1"})] * 2
    assert len(done) == 1


def test_a_question_asked_again_after_many_others_is_not_done_again(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    counting, done = service(), list[Any]()

    def answer(asked: Any) -> Facts:
        done.append(asked["id"])
        return Facts({})

    serve(bus, counting, answer)
    answers = heard(bus, counting.answers)
    asking = connected(bus, counting.questions, eventually)
    eventually(lambda: bus.publisher(counting.answers).listeners)
    others = [f"q{number}" for number in range(20)]
    for number in ("first", *others, "first", "last"):
        asking.publish(Facts({"id": number}))
    given = [answers.next().facts["id"] for _ in range(22)]
    assert given == done == ["first", *others, "last"]


def test_questions_without_a_number_are_each_their_own(
    bus: Bus, heard: Any, eventually: Eventually
) -> None:
    echoing = service()
    serve(bus, echoing, lambda asked: Facts({"said": asked["say"]}))
    answers = heard(bus, echoing.answers)
    asking = connected(bus, echoing.questions, eventually)
    eventually(lambda: bus.publisher(echoing.answers).listeners)
    for word in ("one", "two"):
        asking.publish(Facts({"say": word}))
    assert [answers.next().facts["said"] for _ in range(2)] == ["one", "two"]


def test_who_begins_to_answer_late_still_gets_the_question(bus: Bus) -> None:
    late = service()
    begin = threading.Timer(0.5, serve, (bus, late, lambda asked: Facts({"ok": True})))
    begin.start()
    assert Asking(bus, late, PATIENCE).ask({})["ok"]
    begin.join()


def test_cameras_and_facts_are_values() -> None:
    assert Camera(1, 2, 3, 4, 5, 6) == Camera(*astuple(Camera(1, 2, 3, 4, 5, 6)))
    assert Facts({"a": 1}) == Facts({"a": 1}) != Facts({"a": 2})
