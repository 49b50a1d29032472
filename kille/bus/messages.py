"""What goes over a bus: immutable values, whatever carries them.

Times are whole nanoseconds, so that two pictures of one moment have equal stamps. An
array is read-only once it has been sent, for the sender and for the receivers.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

_NAME = re.compile(r"/?[A-Za-z]\w*(/[A-Za-z]\w*)*", re.ASCII)


class BusError(Exception):
    """Something that a bus cannot do: one line says what, and what to do.

    >>> from kille.bus import Text, Topic
    >>> Topic("user input", Text)
    Traceback (most recent call last):
        ...
    kille.bus.messages.BusError: `user input` cannot name a topic: write letters, digits
    and _, parted by /, such as camera/rgb/image_color
    """


@dataclass(frozen=True)
class Text:
    """What somebody says.

    >>> Text("This is a cup.")
    Text(text='This is a cup.')
    """

    text: str


@dataclass(frozen=True)
class Facts:
    """Names and values, as JSON has them.

    >>> Facts({"command": "look", "things": ["cup", "book"]}).facts["things"]
    ['cup', 'book']
    """

    facts: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Image:
    """A picture and when it was taken.

    Pixels are (H, W, 3) uint8 RGB, or (H, W): float32 metres of depth, NaN for none,
    uint16 millimetres, 0 for none, or uint8 grey.

    >>> import numpy as np
    >>> Image(np.zeros((480, 640, 3), np.uint8), stamp=0).pixels.shape
    (480, 640, 3)
    """

    pixels: Array
    stamp: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "pixels", _read_only_view(self.pixels))


@dataclass(frozen=True)
class Camera:
    """The pinhole model of a camera in pixels, for pictures of this size.

    >>> kinect = Camera(fx=525.0, fy=525.0, cx=319.5, cy=239.5, width=640, height=480)
    >>> kinect.width, kinect.stamp
    (640, 0)
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    stamp: int = 0


@dataclass(frozen=True, eq=False)
class Bundle:
    """Facts with arrays, by name.

    >>> import numpy as np
    >>> seen = Bundle({"name": "cup"}, {"mask": np.ones((2, 3), bool)})
    >>> seen.facts["name"], seen.arrays["mask"].shape
    ('cup', (2, 3))
    """

    facts: Mapping[str, Any]
    arrays: Mapping[str, Array] = field(default_factory=dict)

    def __post_init__(self) -> None:
        own = {name: _read_only_view(it) for name, it in self.arrays.items()}
        object.__setattr__(self, "arrays", own)


Message = Text | Facts | Image | Camera | Bundle
"""What a topic may carry.

>>> from kille.bus import Message, Text
>>> isinstance(Text("Hello."), Message)
True
"""

M = TypeVar("M", bound=Message)


@dataclass(frozen=True)
class Topic(Generic[M]):
    """A name under which messages of one kind are sent.

    At most `waiting` messages wait for a slow receiver; the oldest of more are dropped.
    A late subscriber of a `latched` topic gets the latest message at once. A name that
    begins with `/` is taken as it is, any other belongs to a namespace.

    >>> Topic("user input", Text)
    Traceback (most recent call last):
    kille.bus.messages.BusError: `user input` cannot name a topic: write letters,
    digits and _, parted by /, such as camera/rgb/image_color
    """

    name: str
    kind: type[M]
    waiting: int = 100
    latched: bool = False

    def __post_init__(self) -> None:
        if not _NAME.fullmatch(self.name):
            raise BusError(
                f"`{self.name}` cannot name a topic: write letters, digits and _, "
                "parted by /, such as camera/rgb/image_color"
            )


def _read_only_view(array: Array) -> Array:
    view = np.asarray(array).view()
    view.flags.writeable = False
    return view
