"""The moments of a recording in order of time, read from disk when needed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from kille.scene import Frame
from kille.sensors.captures import RATE

if TYPE_CHECKING:
    from kille.sensors.kinect.calibration import Calibration
    from kille.sensors.kinect.capture import KinectCapture


@dataclass(frozen=True, eq=False)
class Moment:
    """A frame that can be read, and when it was taken, on the recording's own clock.

    `read` raises SensorError if the frame is lost. `capture` is there where the raw
    readings of a Kinect were kept.
    """

    time: float
    read: Callable[[], Frame]
    capture: Callable[[], KinectCapture] | None = None


def _close_nothing() -> None:
    """Close what is not open."""


@dataclass(frozen=True, eq=False)
class RecordedMoments:
    """The moments of a recording, of which there is at least one.

    `format` is its name for people. `remark` says in one line what of the recording is
    not played, if anything. `calibration` is that of the Kinect whose raw readings it
    holds. `close` is called once.
    """

    format: str
    moments: Sequence[Moment]
    remark: str = ""
    calibration: Calibration | None = None
    close: Callable[[], None] = _close_nothing

    @cached_property
    def times(self) -> tuple[float, ...]:
        """Seconds since the first frame, of each.

        >>> from kille.scene import Frame
        >>> def never() -> Frame:
        ...     raise NotImplementedError
        >>> reel = RecordedMoments("TUM", [Moment(7.5, never), Moment(8.0, never)])
        >>> reel.times, reel.lap
        ((0.0, 0.5), 1.0)
        """
        return tuple(it.time - self.moments[0].time for it in self.moments)

    @property
    def lap(self) -> float:
        """Seconds from the first frame to its return, when the recording is looped.

        After the last frame the usual time between two frames passes.
        """
        duration, gaps = self.times[-1], len(self.times) - 1
        return duration + (duration / gaps if duration > 0 else 1 / RATE)


def after(last: float, time: float) -> float:
    """The time of a frame to be written, which is not that of the last.

    Files are named by microseconds, so that frames have to be two of them apart.

    >>> after(1.0, 1.25), after(1.0, 1.0)
    (1.25, 1.000002)
    """
    return max(time, last + 2e-6)


def remark_on(lost: Sequence[str], count: int) -> str:
    """What to say of the files that are not there or not whole, of so many in all.

    >>> remark_on(["rgb/2.png"], 40)
    'cut short: 1 of 40 files is missing or not whole (rgb/2.png); the rest is played'
    """
    if not lost:
        return ""
    which = lost[0] if len(lost) == 1 else f"{lost[0]} and others"
    are = "is" if len(lost) == 1 else "are"
    return (
        f"cut short: {len(lost)} of {count} files {are} missing or not whole "
        f"({which}); the rest is played"
    )
