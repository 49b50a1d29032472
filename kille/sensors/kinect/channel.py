"""Values sent to another process and back, with few calls of the system.

After each call of the system a thread waits for the interpreter's lock, which takes ten
milliseconds if two others compute in Python. So a value is sent in one call, and comes
in one, if it is short.
"""

from __future__ import annotations

import pickle
import socket
import struct
from typing import Any

_SIZE = struct.Struct("<Q")
_ONCE = 1 << 16
_WHOLE, _MICRO = 1, 1_000_000


class Channel:
    """One end of a connection between two processes that trust each other.

    After any error it is of no more use. EOFError if the other end was closed.
    """

    def __init__(self, end: socket.socket) -> None:
        self._end = end
        self._patience: float | None = None

    def send(self, value: Any) -> None:
        """Send a value that can be pickled."""
        message = pickle.dumps(value)
        self._end.sendall(_SIZE.pack(len(message)) + message)

    def receive(self, seconds: float) -> Any:
        """The next value that comes; TimeoutError if none begins to in that time."""
        self._wait_at_most(seconds)
        came = bytearray()
        while len(came) < _SIZE.size or len(came) < _SIZE.size + _size(came):
            came += self._receive()
        return pickle.loads(bytes(came[_SIZE.size :]))

    def close(self) -> None:
        """Close this end: the other one finds out when it receives."""
        self._end.close()

    def _receive(self) -> bytes:
        try:
            part = self._end.recv(_ONCE)
        except BlockingIOError:
            raise TimeoutError from None
        if not part:
            raise EOFError
        return part

    def _wait_at_most(self, seconds: float) -> None:
        # Python's own way to limit the time asks first whether there is something.
        if seconds != self._patience:
            limit = struct.pack("@ll", int(seconds), int(seconds % _WHOLE * _MICRO))
            self._end.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, limit)
            self._patience = seconds


def _size(came: bytearray) -> int:
    return int(_SIZE.unpack_from(came)[0])
