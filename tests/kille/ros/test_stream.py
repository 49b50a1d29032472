"""Frames over a bus as a sensor: paired by time, converted; what is missing is told."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Condition, Event, Thread
from typing import Any, TypeVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.bus import (
    BusError,
    Camera,
    Image,
    LocalBus,
    Message,
    Publisher,
    Subscription,
    Topic,
)
from kille.bus.pixels import encoding_of, pixels_of
from kille.scene import Frame
from kille.sensors.bus_sensor import Feed, Stream
from kille.sensors.ros import feed_of
from kille.sensors.sensor import SensorError
from kille.sensors.sources import open_sensor

FEED = Feed.of_topics("a/image", "a/camera_info", "a/depth")
MOMENT = 33_000_000
LENS = Camera(525.0, 525.0, 1.5, 1.0, 4, 3)


PATIENCE = 60.0

M = TypeVar("M", bound=Message)


class Taken(LocalBus):
    """A bus of which it can be told how many messages were taken."""

    def __init__(self) -> None:
        super().__init__()
        self._changed, self._count = Condition(), 0

    def subscribe(self, topic: Topic[M], take: Callable[[M], None]) -> Subscription:
        def counted(message: M) -> None:
            take(message)
            with self._changed:
                self._count += 1
                self._changed.notify_all()

        return super().subscribe(topic, counted)

    def send(self, publisher: Publisher[M], message: M) -> None:
        """Send a message, and wait until it has been taken."""
        with self._changed:
            count = self._count + 1
            publisher.publish(message)
            assert self._changed.wait_for(lambda: self._count == count, PATIENCE)


class Driver:
    """A camera that sends what it is told to; it is taken before it goes on."""

    def __init__(self, feed: Feed = FEED, patience: float = PATIENCE) -> None:
        self.bus = Taken()
        self.stream = Stream(self.bus, feed, "a camera", patience)
        self._colour: Publisher[Image] = self.bus.publisher(feed.colour)
        self._camera: Publisher[Camera] = self.bus.publisher(feed.camera)
        self._depth = None if feed.depth is None else self.bus.publisher(feed.depth)

    def calibrated(self) -> Driver:
        self.bus.send(self._camera, LENS)
        return self

    def colour(self, stamp: int, value: int = 0) -> None:
        self.picture(Image(np.full((3, 4, 3), value, np.uint8), stamp))

    def picture(self, image: Image) -> None:
        self.bus.send(self._colour, image)

    def depth(self, stamp: int, pixels: Any = None) -> None:
        assert self._depth is not None
        found = np.ones((3, 4), np.float32) if pixels is None else pixels
        self.bus.send(self._depth, Image(found, stamp))

    @contextmanager
    def sending(self, *sent: Any) -> Iterator[Stream]:
        """A stream to which these are sent over and over, whenever one waits."""
        enough = Event()

        def send() -> None:
            while not enough.wait(0.01):
                for send_it, *of in sent:
                    send_it(*of)

        thread = Thread(target=send)
        thread.start()
        try:
            yield self.stream
        finally:
            enough.set()
            thread.join()

    def frame(self, *sent: Any) -> Frame:
        """The next frame, while these are sent."""
        with self.sending(*sent) as stream:
            return stream.frame()

    def close(self) -> None:
        self.stream.close()
        self.bus.close()


@pytest.fixture
def driver() -> Iterator[Driver]:
    made = Driver().calibrated()
    yield made
    made.close()


def test_a_frame_is_the_colour_and_depth_of_one_moment(driver: Driver) -> None:
    frame = driver.frame(
        (driver.colour, 1 * MOMENT, 1),
        (driver.depth, 2 * MOMENT + 5_000_000),
        (driver.colour, 2 * MOMENT, 2),
    )
    assert frame.time == 2 * MOMENT / 1e9
    assert np.all(frame.colour == 2)
    assert frame.intrinsics is not None
    assert frame.intrinsics.fx == LENS.fx


def test_what_came_before_a_frame_was_asked_for_is_passed_over(driver: Driver) -> None:
    driver.depth(1 * MOMENT)
    driver.colour(1 * MOMENT)
    later = (driver.depth, 2 * MOMENT), (driver.colour, 2 * MOMENT)
    assert driver.frame(*later).time == 2 * MOMENT / 1e9


def test_pictures_of_a_driver_without_a_clock_count(driver: Driver) -> None:
    frame = driver.frame((driver.depth, 0), (driver.colour, 0))
    assert frame.time == 0.0


def test_only_frames_after_a_moment_count_if_that_is_asked(driver: Driver) -> None:
    both = [
        (send, n * MOMENT) for n in (1, 2, 3) for send in (driver.depth, driver.colour)
    ]
    with driver.sending(*both) as stream:
        assert stream.frame_after(2 * MOMENT).time == 3 * MOMENT / 1e9


def test_millimetres_become_metres_and_what_is_no_reading_is_none(
    driver: Driver,
) -> None:
    depth = np.array([[0, 500, 1000, 65535]] * 3, np.uint16)
    found = driver.frame((driver.depth, MOMENT, depth), (driver.colour, MOMENT)).depth
    assert found is not None
    assert found.dtype == np.float32
    np.testing.assert_allclose(found[0], [np.nan, 0.5, 1.0, 65.535])


@pytest.mark.parametrize("none", [0.0, -1.0, np.nan])
def test_no_reading_in_metres_is_none_too(driver: Driver, none: float) -> None:
    depth = np.full((3, 4), 2.0, np.float32)
    depth[0, 0] = none
    found = driver.frame((driver.depth, MOMENT, depth), (driver.colour, MOMENT)).depth
    assert found is not None
    assert np.isnan(found).sum() == 1


def test_without_a_depth_topic_frames_are_of_colour_alone() -> None:
    driver = Driver(Feed.of_topics("a/image", "a/camera_info"))
    frame = driver.frame((driver.colour, MOMENT))
    assert frame.depth is None
    assert frame.intrinsics is None
    driver.close()


def test_what_is_missing_is_one_line_each() -> None:
    driver = Driver(patience=0.15)

    def failing() -> str:
        with pytest.raises(SensorError) as caught:
            driver.stream.frame()
        return str(caught.value)

    assert "no picture came on a/image within 0.15 s" in failing()
    driver.colour(MOMENT)
    assert "colour comes, but no depth on a/depth" in failing()
    driver.depth(9 * MOMENT)
    assert "not of the same moments" in failing()
    driver.close()


def test_a_picture_without_calibration_is_one_line() -> None:
    driver = Driver(patience=1.0)
    with pytest.raises(SensorError, match="nothing on a/camera_info"):
        driver.frame((driver.depth, MOMENT), (driver.colour, MOMENT))
    driver.close()


def test_depth_of_another_size_than_colour_is_one_line(driver: Driver) -> None:
    small = (driver.depth, MOMENT, np.ones((2, 2), np.float32))
    with pytest.raises(SensorError, match="depth is 2x2 but colour is 4x3"):
        driver.frame(small, (driver.colour, MOMENT))


def test_a_grey_picture_has_no_colour() -> None:
    driver = Driver(Feed.of_topics("a/image", "a/camera_info"))
    grey = Image(np.zeros((3, 4), np.uint8), MOMENT)
    with pytest.raises(SensorError, match="has no colour"):
        driver.frame((driver.picture, grey))
    driver.close()


# --- topics --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("colour", "sent", "depth"),
    [
        ("/camera/rgb/image_color", "/camera/depth_registered/image_raw", True),
        ("/k/color/image_raw", "/k/depth/image_rect_raw", True),
        ("/camera/rgb/image_color", "/other/depth/image", False),
    ],
)
def test_depth_is_found_where_drivers_put_it(
    colour: str, sent: str, depth: bool
) -> None:
    feed = feed_of(colour, [colour, sent], "", "")
    assert (feed.depth is not None and feed.depth.name == sent) == depth
    assert feed.camera.name == colour.rpartition("/")[0] + "/camera_info"


def test_depth_and_calibration_can_be_named() -> None:
    feed = feed_of("/a/b/c", [], "/d", "/e")
    assert feed.depth is not None
    assert (feed.depth.name, feed.camera.name) == ("/d", "/e")
    assert feed_of("/a/b/c", ["/a/depth/image"], "none", "").depth is None


@pytest.mark.parametrize(
    ("name", "because"),
    [
        ("ros:/a?dpth=/b", "unknown option `dpth`"),
        ("ros:/a?patience=long", "number of seconds, not `long`"),
        ("ros:/a?patience=-1", "number of seconds"),
        ("ros:/a?patience=nan", "number of seconds"),
    ],
)
def test_a_wrong_option_is_one_line(name: str, because: str) -> None:
    with pytest.raises(SensorError, match=because):
        open_sensor(name)


# --- pixels --------------------------------------------------------------------------

PICTURES = {
    "rgb8": (np.uint8, 3),
    "bgr8": (np.uint8, 3),
    "rgba8": (np.uint8, 4),
    "bgra8": (np.uint8, 4),
    "mono8": (np.uint8, 1),
    "mono16": (np.uint16, 1),
    "16UC1": (np.uint16, 1),
    "32FC1": (np.float32, 1),
}


@given(
    st.sampled_from(sorted(PICTURES)),
    st.integers(1, 5),
    st.integers(1, 5),
    st.integers(0, 7),
    st.booleans(),
)
def test_pixels_are_read_whatever_their_order_and_padding(
    encoding: str, height: int, width: int, padding: int, big_endian: bool
) -> None:
    kind, channels = PICTURES[encoding]
    count = height * width * channels
    values = np.arange(1, count + 1).astype(kind).reshape(height, width * channels)
    order = ">" if big_endian else "<"
    rows = values.astype(np.dtype(kind).newbyteorder(order)).view(np.uint8)
    data = np.pad(rows, ((0, 0), (0, padding))).tobytes()
    step = rows.shape[1] + padding
    found = pixels_of(data, encoding, height, width, step, big_endian)
    expected = values.reshape(height, width, channels)[..., :3]
    if encoding.startswith("bgr"):
        expected = expected[..., ::-1]
    np.testing.assert_array_equal(found, expected if channels > 1 else values)
    assert found.dtype == kind
    if encoding in ("rgb8", "mono8", "16UC1", "32FC1"):
        assert encoding_of(found) == encoding


@pytest.mark.parametrize(
    ("encoding", "size", "because"),
    [("yuv422", 100, "encoded as yuv422"), ("rgb8", 11, "too few bytes: 11")],
)
def test_what_cannot_be_read_is_one_line(
    encoding: str, size: int, because: str
) -> None:
    with pytest.raises(BusError, match=because):
        pixels_of(bytes(size), encoding, 2, 2, 6, False)


def test_what_is_no_picture_cannot_be_sent() -> None:
    with pytest.raises(BusError, match="are no picture"):
        encoding_of(np.zeros((2, 2), np.complex128))
