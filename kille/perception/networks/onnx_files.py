"""Write a network as an ONNX file, which OpenCV reads.

ONNX is a protocol buffer: fields, each with a number and a type, one after the other.
Only what a network of convolutions needs is written here: nodes with attributes of
whole numbers, constants and pictures of float32.
Source: `onnx/onnx.proto`, version 8 of the format, operators of version 13.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_FORMAT, _OPERATORS = 8, 13
_FLOAT = 1  # the number of float32 among the types of tensors
_INT, _INTS = 2, 7  # of an attribute
_VARINT, _BYTES = 0, 2  # how a field is written


class Port(NamedTuple):
    """What goes into a network or comes out of it: its name and its shape."""

    name: str
    shape: tuple[int, ...]


def node(
    operator: str, inputs: Sequence[str], output: str, **attributes: int | Sequence[int]
) -> bytes:
    """A node that computes `output` from `inputs`; all are names."""
    return b"".join(
        [
            *(_text(1, name) for name in inputs),
            _text(2, output),
            _text(3, output),
            _text(4, operator),
            *(_bytes(5, _attribute(*it)) for it in attributes.items()),
        ]
    )


def constant(name: str, numbers: NDArray[np.float32]) -> bytes:
    """An array by name."""
    shape = b"".join(_number(1, side) for side in numbers.shape)
    raw = np.ascontiguousarray(numbers, "<f4").tobytes()
    return shape + _number(2, _FLOAT) + _text(8, name) + _bytes(9, raw)


def onnx_file(
    name: str, nodes: Iterable[bytes], constants: Iterable[bytes], into: Port, out: Port
) -> bytes:
    """A network as a file: nodes in the order in which they are computed."""
    graph = b"".join(
        [
            *(_bytes(1, it) for it in nodes),
            _text(2, name),
            *(_bytes(5, it) for it in constants),
            _bytes(11, _port(into)),
            _bytes(12, _port(out)),
        ]
    )
    operators = _text(1, "") + _number(2, _OPERATORS)
    return _number(1, _FORMAT) + _bytes(7, graph) + _bytes(8, operators)


def _port(port: Port) -> bytes:
    sides = b"".join(_bytes(1, _number(1, side)) for side in port.shape)
    return _text(1, port.name) + _bytes(
        2, _bytes(1, _number(1, _FLOAT) + _bytes(2, sides))
    )


def _attribute(name: str, value: int | Sequence[int]) -> bytes:
    if isinstance(value, int):
        return _text(1, name) + _number(3, value) + _number(20, _INT)
    numbers = b"".join(_number(8, it) for it in value)
    return _text(1, name) + numbers + _number(20, _INTS)


def _number(field: int, value: int) -> bytes:
    return _varint(field << 3 | _VARINT) + _varint(value)


def _text(field: int, text: str) -> bytes:
    return _bytes(field, text.encode())


def _bytes(field: int, content: bytes) -> bytes:
    return _varint(field << 3 | _BYTES) + _varint(len(content)) + content


def _varint(number: int) -> bytes:
    """A whole number from 0 in groups of seven bits, the lowest first.

    >>> _varint(300)
    b'\\xac\\x02'
    """
    groups = bytearray()
    while number > 127:
        groups.append(number & 127 | 128)
        number >>= 7
    return bytes([*groups, number])
