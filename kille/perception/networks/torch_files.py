"""Read the weights that PyTorch wrote to a file, without PyTorch.

Such a file, as `torch.save` wrote it until version 1.6, is five pickles (a number that
marks the format, its version, facts about the machine, the tensors by name, the keys of
the storages), followed by the numbers of each storage. A tensor says where in which
storage it starts, and its strides.

A pickle can name any function for the reader to call. This reader knows three names,
and makes nothing but arrays of them; a file with any other name is refused.
Source: `torch/serialization.py`, `_legacy_load`.
"""

from __future__ import annotations

import io
import pickle
import struct
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

_MAGIC = 0x1950A86A20F9469CFC6C
_STORAGES = {"FloatStorage": np.dtype("<f4"), "LongStorage": np.dtype("<i8")}


class _Storage(NamedTuple):
    """A run of numbers: its key, the type of its numbers and how many there are."""

    key: str
    type: np.dtype[Any]
    size: int


class _Tensor(NamedTuple):
    """Part of a storage: its first number, its shape, and strides in numbers."""

    storage: _Storage
    start: int
    shape: Sequence[int]
    strides: Sequence[int]


def read_weights(data: bytes) -> dict[str, NDArray[Any]]:
    """The arrays of a file of weights, by name; they cannot be written to.

    ValueError if the data are not those of such a file.
    """
    try:
        return _arrays(data)
    except Exception as error:  # a pickle that is not one can fail in any way
        raise ValueError(f"these are no weights as PyTorch writes them: {error}") from (
            error
        )


def _arrays(data: bytes) -> dict[str, NDArray[Any]]:
    file = io.BytesIO(data)
    if _Reader(file).load() != _MAGIC:
        raise ValueError("the mark of the format is missing")
    _version, _machine = _Reader(file).load(), _Reader(file).load()
    tensors: Mapping[str, _Tensor] = _Reader(file).load()
    keys: Sequence[str] = _Reader(file).load()
    storages = {it.storage.key: it.storage for it in tensors.values()}
    numbers = {key: _numbers(file, storages[key]) for key in keys}
    return {
        name: np.ndarray(
            tuple(it.shape),
            it.storage.type,
            numbers[it.storage.key],
            it.start * it.storage.type.itemsize,
            tuple(step * it.storage.type.itemsize for step in it.strides),
        )
        for name, it in tensors.items()
    }


def _numbers(file: io.BytesIO, storage: _Storage) -> bytes:
    """The numbers of the storage, which come after how many there are."""
    (size,) = struct.unpack("<q", file.read(8))
    if size != storage.size:
        raise ValueError(f"a storage has {size} numbers, not {storage.size}")
    return file.read(size * storage.type.itemsize)


class _Reader(pickle.Unpickler):
    """A reader of pickles in which only tensors can be named."""

    def find_class(self, module: str, name: str, /) -> Any:
        match module, name:
            case "collections", "OrderedDict":
                return OrderedDict
            case "torch._utils", "_rebuild_tensor_v2":
                return _tensor
            case "torch", it if it in _STORAGES:
                return _STORAGES[it]
        raise pickle.UnpicklingError(f"{module}.{name} is no part of a tensor")

    def persistent_load(self, identity: Any, /) -> _Storage:
        kind, numbers, key, _device, size, _view = identity
        if kind != "storage":
            raise pickle.UnpicklingError(f"{kind!r} is no storage of a tensor")
        return _Storage(key, numbers, size)


def _tensor(
    storage: _Storage, start: int, shape: Sequence[int], strides: Sequence[int], *_: Any
) -> _Tensor:
    return _Tensor(storage, start, shape, strides)
