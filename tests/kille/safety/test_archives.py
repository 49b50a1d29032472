"""Archives are unpacked no further than they may be, whatever their heads say."""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from kille.safety.archives import (
    DamagedArchiveError,
    check_sizes,
    open_zip,
    read_arrays,
    read_head,
    read_member,
)
from ttr.safety.limits import DIRECTORY, InputLimitError, Limit

FEW = Limit(1000, "bytes")


def zipped(*files: tuple[str, bytes], way: int = zipfile.ZIP_DEFLATED) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", way) as archive:
        for name, content in files:
            archive.writestr(name, content)
    return made.getvalue()


def head(shape: tuple[int, ...], kind: str = "|u1") -> bytes:
    made = io.BytesIO()
    told = {"descr": kind, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(made, told)
    return made.getvalue()


def said_to_be(size: int, data: bytes) -> bytes:
    """The zip, of which the list says that its last file has so many bytes."""
    whole = bytearray(data)
    struct.pack_into("<I", whole, whole.rfind(b"PK\x01\x02") + 24, size)
    return bytes(whole)


@given(
    st.dictionaries(
        st.text("abc", min_size=1, max_size=3),
        arrays.arrays(
            st.sampled_from(["u1", "<u2", ">i4", "<f4", "f8", "?", "U3", "S2"]),
            arrays.array_shapes(min_dims=0, min_side=0, max_side=4),
        ),
        max_size=3,
    ),
    st.booleans(),
)
def test_arrays_are_read_as_numpy_reads_them(
    held: dict[str, np.ndarray], is_packed: bool
) -> None:
    made = io.BytesIO()
    (np.savez_compressed if is_packed else np.savez)(made, **held)
    found = read_arrays(made.getvalue())
    assert found.keys() == held.keys()
    for name, array in held.items():
        assert found[name].dtype == array.dtype
        assert found[name].flags.writeable
        np.testing.assert_array_equal(found[name], array)


def test_an_array_by_columns_is_read_as_it_was() -> None:
    made = io.BytesIO()
    np.savez(made, a=np.asfortranarray(np.arange(6).reshape(2, 3)))
    np.testing.assert_array_equal(
        read_arrays(made.getvalue())["a"], [[0, 1, 2], [3, 4, 5]]
    )


def test_an_array_with_a_long_head_is_read() -> None:
    """NumPy writes the second version where the first has not enough room."""
    made = io.BytesIO()
    told = {"descr": "|u1", "fortran_order": False, "shape": (3,)}
    np.lib.format.write_array_header_2_0(made, told)
    found = read_arrays(zipped(("a.npy", made.getvalue() + b"abc")))
    assert found["a"].tobytes() == b"abc"


TOO_MUCH: dict[str, Callable[[], object]] = {
    "zeros that are well compressed": lambda: read_arrays(
        zipped(("a.npy", head((10**7,)) + bytes(10**7))), FEW
    ),
    "several that are small": lambda: read_arrays(
        zipped(*((f"{it}.npy", head((200,)) + bytes(200)) for it in range(9))), FEW
    ),
    "a member": lambda: _member(zipped(("a", bytes(1001)))),
    "members together": lambda: _members(zipped(("a", bytes(600)), ("b", bytes(600)))),
}


def _member(data: bytes) -> None:
    with open_zip(data) as archive:
        read_member(archive, "a", FEW)


def _members(data: bytes) -> None:
    with open_zip(data) as archive:
        check_sizes(archive, FEW)


@pytest.mark.parametrize("read", TOO_MUCH.values(), ids=TOO_MUCH)
def test_what_is_too_much_is_not_unpacked(read: Callable[[], object]) -> None:
    with pytest.raises(InputLimitError, match="and no more than 1 kB are read"):
        read()


DAMAGED = {
    "a shape that is not there": zipped(("a.npy", head((10**12,)) + bytes(9))),
    "a shape below zero": zipped(("a.npy", head((-1,)) + bytes(9))),
    "a shape beyond numbers": zipped(("a.npy", head((2**70, 2**70)) + bytes(9))),
    "more than its shape": zipped(("a.npy", head((3,)) + bytes(9))),
    "objects": zipped(("a.npy", head((1,), "|O") + bytes(8))),
    "less than it has": said_to_be(140, zipped(("a.npy", head((9,)) + bytes(9)))),
    "more than it has": said_to_be(999, zipped(("a.npy", head((9,)) + bytes(9)))),
    "another way to compress": zipped(("a.npy", head((9,)) + bytes(9)), way=14),
    "no array": zipped(("a.npy", b"PK")),
    "an archive in an archive": zipped(("a.npy", zipped(("a.npy", b"")))),
    "no archive": b"PK\x03\x04",
    "nothing": b"",
}


@pytest.mark.parametrize("content", DAMAGED.values(), ids=DAMAGED)
def test_what_does_not_fit_is_damaged(content: bytes) -> None:
    with pytest.raises(DamagedArchiveError):
        read_arrays(content, FEW)


@pytest.mark.parametrize("shape", [(-1,), (3, -1), (-2, -3)])
def test_a_head_with_a_shape_below_zero_is_damaged(shape: tuple[int, ...]) -> None:
    with pytest.raises(DamagedArchiveError, match="the shape of an array cannot be"):
        read_head(io.BytesIO(head(shape)))
    assert read_head(io.BytesIO(head((0, 3)))).size == 0


def test_no_more_is_unpacked_than_the_list_says() -> None:
    data = said_to_be(10, zipped(("a", bytes(10**6))))
    with open_zip(data) as archive, pytest.raises(DamagedArchiveError, match="CRC"):
        read_member(archive, "a", FEW)


def test_what_is_in_a_zip_may_be_larger_than_its_list(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        "kille.safety.archives._Bounded.limit", Limit(10_000, DIRECTORY.unit)
    )
    data = zipped(("a", bytes(20_000)), way=zipfile.ZIP_STORED)
    with open_zip(data) as archive:
        assert read_member(archive, "a", Limit(20_000, "bytes")) == bytes(20_000)


def test_a_list_without_end_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    data = zipped(*((f"{it}", b"") for it in range(300)))
    monkeypatch.setattr(
        "kille.safety.archives._Bounded.limit", Limit(10_000, DIRECTORY.unit)
    )
    with pytest.raises(InputLimitError, match="no more than 10 kB"), open_zip(data):
        pass
