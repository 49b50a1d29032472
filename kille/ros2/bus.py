"""The bus over the topics of ROS 2, by DDS alone. Experimental.

Topics, types and bytes are those of ROS 2, so its nodes should hear ours and be heard;
this was only tried between nodes of ours. There is no node in ROS 2's own sense:
`ros2 topic` may list the topics, `ros2 node` nothing.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from threading import Event, Thread, current_thread
from typing import Any, Generic, TypeVar

from kille.bus import (
    BusError,
    Camera,
    Image,
    Message,
    Publisher,
    Subscription,
    Topic,
)
from kille.bus.interface import SerialReceiver, TopicKinds
from kille.ros2.conversion import Ros2Form, form_of
from kille.ros2.types import module, sample_type

M = TypeVar("M", bound=Message)

_TURN = 0.2
"""Seconds after which a listener looks whether it has been closed."""

_STREAMED = (Image, Camera)
"""Kinds of which there is always a next: cameras keep none for who is late."""


def open_ros2(name: str, arguments: Sequence[str] = ()) -> DdsBus:
    """The bus of the domain that `ROS_DOMAIN_ID` names, 0 if nothing does.

    `arguments` are remappings, `user_input:=/chat`. BusError where the extra `ros2` is
    not installed, or the domain cannot be entered.
    """
    text = os.environ.get("ROS_DOMAIN_ID", "0")
    if not text.isdecimal():
        raise BusError(f"ROS_DOMAIN_ID is `{text}`; it is a number from 0 on")
    pairs = [argument.partition(":=") for argument in arguments]
    wrong = next((whole for whole, sign, _ in pairs if not sign), None)
    if wrong is not None:
        raise BusError(f"`{wrong}` is no remapping, such as user_input:=/chat")
    try:
        participant = module("cyclonedds.domain").DomainParticipant(int(text))
    except module("cyclonedds.core").DDSException as error:
        raise BusError(
            f"the DDS domain {text} cannot be entered ({error}): see ROS_DOMAIN_ID and "
            "CYCLONEDDS_URI"
        ) from error
    return DdsBus(participant, name, {old: new for old, _, new in pairs})


class DdsBus:
    """Carries messages over DDS under the names of ROS 2; `open_ros2` gives it."""

    def __init__(self, participant: Any, node: str, names: Mapping[str, str]) -> None:
        self._participant, self.node, self._names = participant, node, names
        self._kinds = TopicKinds()
        self._topics: dict[tuple[str, str], Any] = {}
        self._opened: list[_Sending[Any] | _Listening[Any]] = []
        self._ended = Event()

    def full_name(self, name: str) -> str:
        """The full name that a name comes to, as remapped."""
        return f"/{self._names.get(name, name).lstrip('/')}"

    def parameter(self, name: str, default: Any) -> Any:
        """What is meant where nothing is given: parameters are not asked for."""
        return default

    def wait(self) -> None:
        """Wait until the bus is closed."""
        self._ended.wait()

    def publisher(self, topic: Topic[M]) -> Publisher[M]:
        """A way to send messages under this topic."""
        form = self._form(topic)
        quality = _quality(topic, lasting=topic.latched)
        writer = module("cyclonedds.pub").DataWriter(
            self._participant, self._topic(topic, form), qos=quality
        )
        sending = _Sending[M](writer, form)
        self._opened.append(sending)
        return sending

    def subscribe(self, topic: Topic[M], take: Callable[[M], None]) -> Subscription:
        """Give `take` each message under this topic, from now on."""
        form = self._form(topic)
        lasting = topic.latched and topic.kind not in _STREAMED
        reader = module("cyclonedds.sub").DataReader(
            self._participant,
            self._topic(topic, form),
            qos=_quality(topic, lasting=lasting),
        )
        listening = _Listening[M](reader, topic, form, take)
        self._opened.append(listening)
        return listening

    def close(self) -> None:
        """Send and take nothing more; a second call does nothing."""
        while self._opened:
            self._opened.pop().close()
        self._ended.set()

    def _form(self, topic: Topic[Any]) -> Ros2Form:
        self._kinds.settle(self.full_name(topic.name), topic.kind)
        return form_of(topic.kind)

    def _topic(self, topic: Topic[Any], form: Ros2Form) -> Any:
        """The topic as DDS names those of ROS 2; there is one of a name."""
        key = self.full_name(topic.name), form.name
        if key not in self._topics:
            self._topics[key] = module("cyclonedds.topic").Topic(
                self._participant, f"rt{key[0]}", sample_type(form.name)
            )
        return self._topics[key]


class _Sending(Generic[M]):
    """A publisher, until it is closed."""

    def __init__(self, writer: Any, form: Ros2Form) -> None:
        self._writer, self._form, self._open = writer, form, True

    @property
    def listeners(self) -> int:
        """The number of subscriptions at present."""
        return len(self._writer.get_matched_subscriptions()) if self._open else 0

    def publish(self, message: M) -> None:
        """Send a message to all who listen."""
        if self._open:
            self._writer.write(self._writer.data_type(self._form.to(message)))

    def close(self) -> None:
        """Send no more, once sent messages have arrived; later takers get nothing."""
        if self._open:
            self._open = False
            self._writer.wait_for_acks(module("cyclonedds.util").duration(seconds=1))
            self._writer = None


class _Listening(Generic[M]):
    """A subscription: a thread that takes what comes."""

    def __init__(
        self, reader: Any, topic: Topic[M], form: Ros2Form, take: Callable[[M], None]
    ) -> None:
        self._reader, self._topic, self._form = reader, topic, form
        self._take = SerialReceiver(topic, take)
        self._trouble, self._closing = "", Event()
        name = f"taking /{topic.name}"
        self._thread = Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    @property
    def trouble(self) -> str:
        """Why the latest message could not be read."""
        return self._trouble

    def close(self) -> None:
        """Listen no more, once what is being taken has been taken."""
        self._closing.set()
        if self._thread is not current_thread():
            self._thread.join()

    def _run(self) -> None:
        turn = module("cyclonedds.util").duration(seconds=_TURN)
        waiting = _unread_samples(self._reader)
        while not self._closing.is_set():
            for sample in self._reader.take_iter(waiting, timeout=turn):
                if self._closing.is_set():
                    return
                if sample.sample_info.valid_data:  # else only somebody has gone
                    self._came(sample.cdr)

    def _came(self, data: bytes) -> None:
        try:
            message = self._form.of(data)
        except BusError as error:
            self._trouble = f"{self._topic.name}: {error}"
            return
        self._trouble = ""
        self._take(message)


def _unread_samples(reader: Any) -> Any:
    """What waits to be taken, also of those who have gone since they sent it."""
    core = module("cyclonedds.core")
    states = core.ViewState.Any | core.InstanceState.Any | core.SampleState.NotRead
    return core.ReadCondition(reader, states)


def _quality(topic: Topic[Any], *, lasting: bool) -> Any:
    """How a topic is sent and taken: what is kept for whom, and in which bytes.

    Nothing is given up for lost: a picture is a thousand packets, of which some are.
    """
    qos = module("cyclonedds.qos")
    durability = qos.Policy.Durability
    return qos.Qos(
        qos.Policy.Reliability.Reliable(10**9),
        durability.TransientLocal if lasting else durability.Volatile,
        qos.Policy.History.KeepLast(1 if topic.latched else topic.waiting),
        qos.Policy.DataRepresentation(use_cdrv0_representation=True),
    )
