"""Playing a recording: frame by frame as asked, or as fast as it was taken."""

from __future__ import annotations

import time
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

from kille.scene import Frame
from kille.sensors.recordings.moments import Moment, RecordedMoments
from kille.sensors.recordings.playback_options import Options
from kille.sensors.sensor import SensorError

if TYPE_CHECKING:
    from kille.sensors.kinect.calibration import Calibration
    from kille.sensors.kinect.capture import KinectCapture

_KEPT_FRAMES = 16


class RecordingOverError(SensorError):
    """The last frame was given, and the recording does not begin again.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.sensors.recordings import open_recording
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cup.ppm").write_bytes(b"P6 1 1 255 ...")
    ...     recording = open_recording(f"{folder}/cup.ppm?loop=no")
    ...     _ = recording.frame()
    ...     recording.frame()
    Traceback (most recent call last):
        ...
    kille.sensors.recordings.playback.RecordingOverError: .../cup.ppm?loop=no: the
    recording is over after its 1 frames; without loop=no it begins again
    """


@dataclass(frozen=True)
class PlaybackClock:
    """A clock: seconds since some moment, and a way to wait."""

    now: Callable[[], float] = time.monotonic
    wait: Callable[[float], None] = time.sleep


class Pace(Protocol):
    """Decides which moment is next, as a count over all laps."""

    def next(self, reel: RecordedMoments, given: int) -> int:
        """The number of the next one, not below `given`."""
        ...

    def begin(self) -> None:
        """Somebody has gone to another moment, which is due when it is asked for."""
        ...


class OnDemandPace:
    """Gives one moment after another, whenever the next is asked for."""

    def next(self, reel: RecordedMoments, given: int) -> int:
        """The one that was not given yet."""
        return given

    def begin(self) -> None:
        """Nothing is ever late."""


class RealTimePace:
    """Gives moments as a camera does: waits for the next, and skips missed ones."""

    def __init__(self, speed: float, clock: PlaybackClock) -> None:
        self._speed = speed
        self._clock = clock
        self._zero: float | None = None

    def begin(self) -> None:
        """The clock begins with the next frame."""
        self._zero = None

    def next(self, reel: RecordedMoments, given: int) -> int:
        """The newest moment that is due and was not given, or the first to come."""
        if self._zero is None:
            self._zero = self._clock.now() - due(reel, given) / self._speed
            return given
        elapsed = (self._clock.now() - self._zero) * self._speed
        newest = latest(reel, elapsed)
        if newest >= given:
            return newest
        self._clock.wait(max(0.0, (due(reel, given) - elapsed) / self._speed))
        return given


def due(reel: RecordedMoments, number: int) -> float:
    """When the moment of this number, counted over all laps, is to be seen.

    In seconds since the first frame, at the speed at which it was taken.
    """
    laps, index = divmod(number, len(reel.moments))
    return laps * reel.lap + reel.times[index]


def latest(reel: RecordedMoments, elapsed: float) -> int:
    """The last moment that is due after so many seconds, counted over all laps."""
    laps, rest = divmod(elapsed, reel.lap)
    return int(laps) * len(reel.times) + bisect_right(reel.times, rest) - 1


class Recording:
    """The frames of a recording in order of time.

    After the last comes the first, or `RecordingOverError`, as the options say. Frames
    are those that were recorded, to the last bit of what their format keeps; their time
    is on the recording's own clock, and goes on when it begins again.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.sensors.recordings import open_recording
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cup.ppm").write_bytes(b"P6 1 1 255 ...")
    ...     recording = open_recording(f"{folder}/cup.ppm?loop=no")
    >>> recording.length
    0.0
    """

    def __init__(
        self,
        name: str,
        reel: RecordedMoments,
        options: Options,
        clock: PlaybackClock | None = None,
    ) -> None:
        self._name = name
        self._reel = reel
        self._options = options
        self._pace: Pace = OnDemandPace()
        if options.speed is not None:
            self._pace = RealTimePace(options.speed, clock or PlaybackClock())
        self._read = lru_cache(maxsize=_KEPT_FRAMES)(_read)
        self._given = 0
        self._closed = False
        self.seek(options.start)
        self._read(reel.moments[self._given])

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    @property
    def reel(self) -> RecordedMoments:
        """What is played."""
        return self._reel

    @property
    def rest(self) -> Sequence[Moment]:
        """The moments that come before the recording is over or begins again."""
        count = len(self._reel.moments)
        next_one = self._given % count if self._options.loop else self._given
        return self._reel.moments[next_one:]

    @property
    def length(self) -> float:
        """Seconds from the first frame to the last."""
        return self._reel.times[-1]

    @property
    def position(self) -> float:
        """Where the next frame is, in seconds since the first."""
        return self._reel.times[self._given % len(self._reel.times)]

    def seek(self, seconds: float) -> None:
        """Go to the first frame at or after so many seconds since the first.

        SensorError beyond the last.
        """
        # Files tell whole microseconds: what was 0.1 seconds may be a hair less.
        number = bisect_left(self._reel.times, seconds - 1e-5)
        if number == len(self._reel.times):
            raise SensorError(
                f"{self._name}: start={seconds:g} is behind the end; the recording "
                f"is {self._reel.times[-1]:.2f} seconds long"
            )
        self._given = number
        self._pace.begin()

    def frame(self) -> Frame:
        """The next frame; SensorError if its files cannot be read."""
        number = self._next()
        frame = self._read(self._reel.moments[number % len(self._reel.moments)])
        self._given = number + 1
        return replace(frame, time=due(self._reel, number))

    def close(self) -> None:
        """Let go of the source; a second call does nothing."""
        if not self._closed:
            self._closed = True
            self._reel.close()

    def _next(self) -> int:
        """The number of the moment to give."""
        count = len(self._reel.moments)
        number = self._pace.next(self._reel, self._given)
        if self._options.loop or number < count:
            return number
        if self._given < count:
            return count - 1
        raise RecordingOverError(
            f"{self._name}: the recording is over after its "
            f"{count} frames; without loop=no it begins again"
        )


class RawRecording(Recording):
    """A replay of what a Kinect read, which gives the raw readings too."""

    def __init__(
        self,
        name: str,
        reel: RecordedMoments,
        options: Options,
        calibration: Calibration,
        clock: PlaybackClock | None = None,
    ) -> None:
        super().__init__(name, reel, options, clock)
        self._calibration = calibration

    @property
    def calibration(self) -> Calibration:
        """That of the Kinect whose readings these are."""
        return self._calibration

    def capture(self) -> KinectCapture:
        """The next moment's raw readings; they and frames are one stream."""
        number = self._next()
        moment = self._reel.moments[number % len(self._reel.moments)]
        assert moment.capture is not None, "a reel with a calibration has captures"
        capture = moment.capture()
        self._given = number + 1
        return replace(capture, time=due(self._reel, number))


def _read(moment: Moment) -> Frame:
    return moment.read()
