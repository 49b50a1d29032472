"""The bus over ROS 1: this process becomes a node, and topics are those of ROS."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from http.client import HTTPConnection, HTTPException
from threading import Event
from typing import Any, Generic, TypeVar
from urllib.parse import urlsplit
from xml.parsers.expat import ExpatError
from xmlrpc.client import Error as XMLRPCError
from xmlrpc.client import ServerProxy, Transport

from kille.bus import BusError, Facts, Message, Publisher, Subscription, Topic
from kille.bus.interface import SerialReceiver, TopicKinds
from kille.ros.conversion import Ros1Form, form_of
from kille.ros.system_modules import ros

M = TypeVar("M", bound=Message)

_PATIENCE = 3.0
"""Seconds to wait for the master to answer."""

_LINGER = 0.2
"""Seconds for sent messages to arrive; receivers hang up once they hear of the end."""

_BYTES = 1 << 20
"""How many bytes are received at once: a picture in one or two steps."""


def open_ros(name: str, arguments: Sequence[str] = ()) -> RosBus:
    """The bus of the ROS master that `ROS_MASTER_URI` names.

    From now on this process is a node of that name, unless it is one already: a process
    is at most one node, until it ends. `arguments` are remappings as ROS writes them,
    `user_input:=/chat`, and parameters, `_rate:=10`. BusError if ROS is not there, its
    master does not answer, or the node cannot begin.
    """
    rospy = ros("rospy")
    ros("sensor_msgs.msg")
    reach_master()
    if not rospy.core.is_initialized():
        _begin(rospy, name, arguments)
    return RosBus()


def anonymous(name: str) -> str:
    """A name that no other node has, as each name is unique."""
    return f"{name}_{os.getpid()}_{time.time_ns() // 1_000_000}"


class RosBus:
    """Carries messages over ROS 1, between processes and machines.

    `open_ros` gives it.
    """

    def __init__(self) -> None:
        self._rospy: Any = ros("rospy")
        self._kinds = TopicKinds()
        self._opened: list[_Sending[Any] | _Listening[Any]] = []
        self._ended = Event()
        self._rospy.on_shutdown(self._ended.set)

    @property
    def node(self) -> str:
        """The name of the node that this process is."""
        return str(self._rospy.get_name())

    def full_name(self, name: str) -> str:
        """The full name that a name comes to, in this namespace and as remapped."""
        return str(self._rospy.resolve_name(name))

    def topics(self) -> Sequence[tuple[str, str]]:
        """The names and types of all topics that somebody sends under.

        BusError if the master does not answer.
        """
        reach_master()
        found = self._rospy.get_published_topics()
        return tuple((str(name), str(kind)) for name, kind in found)

    def parameter(self, name: str, default: Any) -> Any:
        """A parameter of this node, or what is meant where it is not set."""
        return self._rospy.get_param(f"~{name}", default)

    def wait(self) -> None:
        """Wait until the node is told to end, as by `rosnode kill`."""
        self._ended.wait()

    def publisher(self, topic: Topic[M]) -> Publisher[M]:
        """A way to send messages under this topic."""
        self._kinds.settle(self.full_name(topic.name), topic.kind)
        sending = _Sending(topic, self._rospy)
        self._opened.append(sending)
        return sending

    def subscribe(self, topic: Topic[M], take: Callable[[M], None]) -> Subscription:
        """Give `take` each message under this topic, from now on."""
        self._kinds.settle(self.full_name(topic.name), topic.kind)
        listening = _Listening(topic, self._rospy, take)
        self._opened.append(listening)
        return listening

    def close(self) -> None:
        """Send and take nothing more; a second call does nothing."""
        while self._opened:
            self._opened.pop().close()


class _Sending(Generic[M]):
    """A publisher, until it is closed."""

    def __init__(self, topic: Topic[M], rospy: Any) -> None:
        self._form, self._open = form_of(topic.kind), True
        self._sent = time.monotonic() - _LINGER
        self._publisher = _connect(
            rospy,
            rospy.Publisher,
            topic.name,
            self._form.sent,
            latch=topic.latched,
            tcp_nodelay=True,
            queue_size=topic.waiting,
        )

    @property
    def listeners(self) -> int:
        """The number of subscriptions at present."""
        return int(self._publisher.get_num_connections())

    def publish(self, message: M) -> None:
        """Send a message to all who listen; it does not wait for them."""
        if self._open:
            self._publisher.publish(self._form.to(message))
            self._sent = time.monotonic()

    def close(self) -> None:
        """Send no more, once what was sent has had the time to arrive."""
        if self._open:
            self._open = False
            time.sleep(max(0.0, self._sent + _LINGER - time.monotonic()))
            self._publisher.unregister()


class _Listening(Generic[M]):
    """A subscription, until it is closed."""

    def __init__(self, topic: Topic[M], rospy: Any, take: Callable[[M], None]) -> None:
        self._form: Ros1Form = form_of(topic.kind)
        self._name, self._kind = topic.name, topic.kind
        self._rospy, self._open = rospy, True
        self._take = SerialReceiver(topic, take)
        self._trouble = ""
        self._subscriber = _connect(
            rospy,
            rospy.Subscriber,
            topic.name,
            self._form.sent,
            self._came,
            queue_size=topic.waiting,
            buff_size=_BYTES,
            tcp_nodelay=True,
        )

    def close(self) -> None:
        """Listen no more, once what is being taken has been taken."""
        if self._open:
            self._open = False
            self._subscriber.unregister()
        self._take.close()

    @property
    def trouble(self) -> str:
        """Why the latest message could not be read."""
        return self._trouble

    def _came(self, sent: Any) -> None:
        if not self._open:
            return
        try:
            message = self._form.of(sent)
        except BusError as error:
            self._complain(f"{self._name}: {error}")
            return
        self._trouble = ""
        self._take(message)

    def _complain(self, trouble: str) -> None:
        """Facts may be typed by somebody who looks at a terminal; who waits for a
        picture is told by the one who waits."""
        if self._kind is Facts and trouble != self._trouble:
            self._rospy.logwarn(trouble)
        self._trouble = trouble


def _connect(
    rospy: Any, make: Callable[..., Any], name: str, *of: Any, **how: Any
) -> Any:
    """A publisher or subscriber; BusError if the topic has another type here."""
    try:
        return make(name, *of, **how)
    except rospy.ROSException as error:
        raise BusError(f"/{name.lstrip('/')}: {error}") from error


def reach_master(patience: float = _PATIENCE) -> str:
    """The address of the master, which answers; BusError if it does not.

    A node would wait for it without end.
    """
    uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
    try:
        parts = urlsplit(uri)
        known = parts.scheme == "http" and parts.hostname and parts.port
    except ValueError:
        known = None
    if not known:
        raise BusError(
            f"ROS_MASTER_URI is `{uri}`, which is no address such as "
            "http://localhost:11311"
        )
    try:
        with ServerProxy(uri, _Hasty(patience)) as master:
            master.getPid("/kille")
    except (OSError, HTTPException, XMLRPCError, ExpatError) as error:
        raise BusError(
            f"no ROS master at {uri}: start `roscore` there, or set ROS_MASTER_URI to "
            "where it runs"
        ) from error
    return uri


class _Hasty(Transport):
    """A connection to a server that is given up after some seconds."""

    def __init__(self, patience: float) -> None:
        super().__init__()
        self._patience = patience

    def make_connection(self, host: Any) -> HTTPConnection:
        """The connection, which waits no longer than that."""
        connection = super().make_connection(host)
        connection.timeout = self._patience
        return connection


def _begin(rospy: Any, name: str, arguments: Sequence[str]) -> None:
    """Become a node. Signals stay with the program, and time is that of the clock."""
    try:
        rospy.init_node(
            name,
            [name, *arguments],
            disable_signals=True,
            disable_rostime=True,
        )
    except (rospy.ROSException, ValueError, OSError) as error:
        raise BusError(f"the node {name} cannot begin: {error}") from error
