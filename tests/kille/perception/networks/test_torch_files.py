"""Weights that PyTorch wrote, read without PyTorch."""

from __future__ import annotations

import contextlib
import pickle
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.networks.torch_files import read_weights

STORAGE = b"(S'storage'\nctorch\nFloatStorage\nS'1'\nS'cpu'\nI6\nNtQ"
TENSOR = b"ctorch._utils\n_rebuild_tensor_v2\n(%sI%d\n(I%d\nI%d\nt(I%d\nI%d\ntI00\nNtR"
NUMBERS = np.arange(6, dtype="<f4")
MAGIC = 0x1950A86A20F9469CFC6C


def file_of(
    tensors: bytes, numbers: bytes = NUMBERS.tobytes(), size: int = 6, mark: int = MAGIC
) -> bytes:
    """A file of one storage with the key 1; `tensors` is a pickle."""
    head = b"".join(pickle.dumps(it, 2) for it in (mark, 1001, {"little_endian": True}))
    return head + tensors + pickle.dumps(["1"], 2) + struct.pack("<q", size) + numbers


def tensors_of(start: int, shape: tuple[int, int], strides: tuple[int, int]) -> bytes:
    return b"(S'w'\n" + TENSOR % (STORAGE, start, *shape, *strides) + b"d."


def test_a_tensor_is_read_by_its_strides() -> None:
    found = read_weights(file_of(tensors_of(1, (2, 2), (1, 2))))
    assert found["w"].tolist() == [[1, 3], [2, 4]]
    assert found["w"].dtype == np.float32


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"PK\x03\x04",
        file_of(tensors_of(0, (2, 3), (3, 1)), mark=7),
        file_of(tensors_of(0, (2, 3), (3, 1)), size=5),
        file_of(tensors_of(0, (2, 3), (3, 1)), NUMBERS[:5].tobytes()),
        file_of(tensors_of(3, (2, 3), (3, 1))),
        file_of(tensors_of(0, (2, 3), (-3, 1))),
        file_of(pickle.dumps([1, 2], 2)),
    ],
    ids=["empty", "zip", "mark", "size", "cut", "beyond", "before", "list"],
)
def test_what_is_no_such_file_is_refused(content: bytes) -> None:
    with pytest.raises(ValueError, match="no weights as PyTorch writes them"):
        read_weights(content)


@pytest.mark.parametrize("where", ["mark", "tensors", "keys"])
def test_nothing_that_a_file_names_is_run(where: str) -> None:
    harm = b"cbuiltins\nexec\n(S'raise KeyboardInterrupt'\ntR."
    whole = file_of(tensors_of(0, (2, 3), (3, 1)))
    keys = pickle.dumps(["1"], 2)
    data = {
        "mark": harm,
        "tensors": file_of(harm),
        "keys": whole.replace(keys, harm),
    }[where]
    with pytest.raises(ValueError, match=r"is no part of a tensor"):
        read_weights(data)


@given(drawn=st.data())
def test_a_broken_file_is_refused_or_read(drawn: st.DataObject) -> None:
    whole = bytearray(file_of(tensors_of(0, (2, 3), (3, 1))))
    for _ in range(drawn.draw(st.integers(1, 3))):
        place = drawn.draw(st.integers(0, len(whole) - 1))
        whole[place] = drawn.draw(st.integers(0, 255))
    with contextlib.suppress(ValueError):
        read_weights(bytes(whole))
