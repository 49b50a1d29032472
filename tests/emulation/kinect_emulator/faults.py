"""What can go wrong with a Kinect, as values that a test hands to the emulator."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Harm(Enum):
    """What happens to an isochronous packet."""

    LOST = "never sent; the sequence number goes on"
    TWICE = "sent, and sent again"
    CUT = "sent without its second half"
    SWAPPED = "sent after the next one"
    ALIEN = "sent with another first letter in its header"
    MISPLACED = "sent with the flag of a frame's first packet"


@dataclass(frozen=True)
class PacketFault:
    """Harm to `run` packets in a row out of every `every`, on one endpoint or on all.

    Packets are counted from the start of the stream, across its frames; the first
    `spared` are sent as they should be.

    >>> fault = PacketFault(Harm.LOST, every=100, run=2, spared=500)
    >>> [packet for packet in range(1_000) if fault.hits(0x82, packet)][:4]
    [500, 501, 600, 601]
    """

    harm: Harm
    every: int
    run: int = 1
    endpoint: int | None = None
    spared: int = 0

    def hits(self, endpoint: int, packet: int) -> bool:
        """Whether that packet of the stream at `endpoint` is harmed."""
        if self.endpoint not in (None, endpoint) or packet < self.spared:
            return False
        return (packet - self.spared) % self.every < self.run


class Reply(Enum):
    """What is wrong with the camera's replies to commands."""

    MAGIC = "another first letter"
    COMMAND = "the number of another command"
    TAG = "the tag of another command"
    LENGTH = "a length that is not its own"
    SHORT = "less than a header"
    NEVER = "no reply, however often it is asked for"
    LATE = "nothing, then the full buffer, then the reply"


@dataclass(frozen=True)
class Faults:
    """All that is wrong with one Kinect at one time.

    `silent` endpoints have no packets (`0x81` is video, `0x82` depth); `stalled`
    control transfers fail; `broken` isochronous transfers end in an error; `reply`
    spoils what the camera answers; `forbidden` lets nobody open the device; `busy`
    says that something else has claimed the interface, `driven` that a kernel driver
    has. Isochronous transfers that are `endless` never end, not even when they are
    cancelled. `lost_replies` are the commands, counted from 0 since the Kinect was
    made, whose replies are lost; others come after `slow` microframes. Isochronous
    transfers that are `failing` end as a whole in an error, at their time.
    """

    packets: tuple[PacketFault, ...] = ()
    silent: frozenset[int] = frozenset()
    stalled: bool = False
    broken: bool = False
    reply: Reply | None = None
    forbidden: bool = False
    busy: bool = False
    driven: bool = False
    endless: bool = False
    failing: bool = False
    lost_replies: frozenset[int] = frozenset()
    slow: int = 0


NONE = Faults()
