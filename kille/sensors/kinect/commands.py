"""The camera's commands and their replies, as bytes.

A command is a header 'GM', its length in words of 16 bits, its number and a tag, and
then the words; the reply is the same with 'RB' and bears the number and tag of its
command. All is little-endian.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

READ_REGISTER = 0x02
WRITE_REGISTER = 0x03
FIXED_PARAMETERS = 0x04
ALGORITHM_PARAMETERS = 0x16

REGISTRATION, PADDING, CONST_SHIFT = 0x40, 0x41, 0x00
"""Which of the algorithm's parameters are asked for."""

LONGEST_REPLY = 0x200

_HEADER = struct.Struct("<2sHHH")


class BadReplyError(Exception):
    """The device answered something else than what was asked."""


def command(number: int, tag: int, words: Sequence[int]) -> bytes:
    """The bytes of a command.

    >>> command(WRITE_REGISTER, 7, (0x06, 2)).hex(" ")
    '47 4d 02 00 03 00 07 00 06 00 02 00'
    """
    header = _HEADER.pack(b"GM", len(words), number, tag)
    return header + struct.pack(f"<{len(words)}H", *words)


def payload(reply: bytes, number: int, tag: int, first: int | None = None) -> bytes:
    """What a reply carries; BadReplyError if it does not belong to this command.

    The command may have been sent several times, with the tags from `first` to `tag`.

    >>> payload(bytes.fromhex("52 42 01 00 03 00 07 00 00 00"), WRITE_REGISTER, 7)
    b'\\x00\\x00'
    """
    if len(reply) < _HEADER.size:
        raise BadReplyError(f"command {number:#04x}: a reply of {len(reply)} bytes")
    magic, words, answered, its_tag = _HEADER.unpack_from(reply)
    if magic != b"RB":
        raise BadReplyError(
            f"command {number:#04x}: a reply that begins with {magic.hex()}"
        )
    earlier = 0 if first is None else (tag - first) & 0xFFFF
    if answered != number or (tag - its_tag) & 0xFFFF > earlier:
        raise BadReplyError(
            f"command {number:#04x}, tag {tag}: "
            f"a reply to command {answered:#04x}, tag {its_tag}"
        )
    carried = reply[_HEADER.size :]
    if len(carried) != 2 * words:
        raise BadReplyError(
            f"command {number:#04x}: {len(carried)} bytes of a reply of {2 * words}"
        )
    return carried


def parameters(which: int) -> tuple[int, ...]:
    """The words that ask for parameters of 640x480 pictures, thirty a second."""
    return (which, 0, 1, 30, 0)


def register_value(carried: bytes, register: int) -> int:
    """The value in the reply to READ_REGISTER.

    Raises `BadReplyError` if it is of another length.

    >>> register_value(bytes.fromhex("06 00 02 00"), 0x06)
    2
    """
    if len(carried) != 4:
        raise BadReplyError(
            f"register {register:#04x}: {len(carried)} bytes instead of 4"
        )
    value: int = struct.unpack("<HH", carried)[1]
    return value
