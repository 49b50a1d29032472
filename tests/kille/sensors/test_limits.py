"""What sensors read from files stays within limits, whatever the files say."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.perception.thumbnails import decode_picture as decoded_crop
from kille.sensors.pictures import read_colour, read_depth, read_labels, shows_picture
from kille.sensors.recordings import open_recording
from kille.sensors.sensor import SensorError
from kille.sensors.synthetic.obj_files import load_scan
from ttr.safety.limits import Limit


def png(width: int, height: int, about: bytes = b"\x08\x02\0\0\0") -> bytes:
    """A picture that is whole but for its pixels."""
    parts = [
        (b"IHDR", struct.pack(">II", width, height) + about),
        (b"IDAT", zlib.compress(bytes(100))),
        (b"IEND", b""),
    ]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(content))
        + kind
        + content
        + struct.pack(">I", zlib.crc32(kind + content))
        for kind, content in parts
    )


def jpeg(width: int, height: int) -> bytes:
    data = bytearray(cv2.imencode(".jpg", np.zeros((8, 8, 3), np.uint8))[1].tobytes())
    struct.pack_into(">HH", data, data.index(b"\xff\xc0") + 5, height, width)
    return bytes(data)


def bmp(width: int, height: int) -> bytes:
    data = bytearray(cv2.imencode(".bmp", np.zeros((8, 8, 3), np.uint8))[1].tobytes())
    struct.pack_into("<ii", data, 18, width, height)
    return bytes(data)


def tiff(width: int, height: int) -> bytes:
    data = bytearray(cv2.imencode(".tif", np.zeros((8, 8, 3), np.uint8))[1].tobytes())
    (place,) = struct.unpack_from("<I", data, 4)
    (count,) = struct.unpack_from("<H", data, place)
    for entry in range(place + 2, place + 2 + 12 * count, 12):
        (tag,) = struct.unpack_from("<H", data, entry)
        if tag in (256, 257):
            size = width if tag == 256 else height
            struct.pack_into("<HII", data, entry + 2, 4, 1, size)
    return bytes(data)


def webp(width: int, height: int) -> bytes:
    sizes = (width - 1).to_bytes(3, "little") + (height - 1).to_bytes(3, "little")
    body = b"WEBPVP8X" + struct.pack("<I", 10) + bytes(4) + sizes
    return b"RIFF" + struct.pack("<I", len(body)) + body


def ppm(width: int, height: int) -> bytes:
    return f"P6 {width} {height} 255\n".encode() + bytes(99)


def gif(width: int, height: int) -> bytes:
    return b"GIF89a" + struct.pack("<HH", width, height) + bytes(99)


LARGE = {
    "png": png(30_000, 30_000),
    "jpeg": jpeg(30_000, 30_000),
    "bmp": bmp(30_000, -30_000),
    "tiff": tiff(30_000, 30_000),
    "webp": webp(16_000, 16_000),
    "ppm": ppm(30_000, 30_000),
    "gif": gif(30_000, 30_000),
}


@pytest.fixture
def undecoded(monkeypatch: pytest.MonkeyPatch) -> None:
    """No picture is decoded."""

    def refuse(*_: object) -> None:
        raise AssertionError("it is decoded")

    monkeypatch.setattr(cv2, "imdecode", refuse)


@pytest.mark.parametrize("kind", LARGE)
@pytest.mark.usefixtures("undecoded")
def test_a_large_picture_is_refused_before_it_is_decoded(
    tmp_path: Path, kind: str
) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(LARGE[kind])
    with pytest.raises(SensorError) as caught:
        read_colour(path)
    assert "000,000 pixels, and no more than 50,000,000 pixels" in str(caught.value)
    assert shows_picture(path)
    with pytest.raises(ValueError, match="a kept picture"):
        decoded_crop(LARGE[kind])


@pytest.mark.parametrize("read", [lambda it: read_depth(it, 1000.0), read_labels])
@pytest.mark.usefixtures("undecoded")
def test_what_is_measured_may_be_less_large(
    tmp_path: Path, read: Callable[[Path], object]
) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(png(5000, 5000, b"\x10\0\0\0\0"))
    with pytest.raises(SensorError, match="25,000,000 pixels, and no more than 12"):
        read(path)


@pytest.mark.parametrize("suffix", ["png", "jpg", "bmp", "tif", "webp", "ppm", "gif"])
def test_pictures_of_all_kinds_are_read(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a.{suffix}"
    assert cv2.imwrite(str(path), np.zeros((30, 40, 3), np.uint8))
    assert read_colour(path).shape == (30, 40, 3)
    assert shows_picture(path)


def told(path: Path) -> str:
    with pytest.raises(SensorError) as caught:
        open_recording(str(path))
    said = str(caught.value)
    assert "\n" not in said
    return said


def written_zeros(path: Path, shape: tuple[int, ...], way: int) -> None:
    head = {"descr": "|u1", "fortran_order": False, "shape": shape}
    with zipfile.ZipFile(path, "w", way, compresslevel=1) as archive:
        made = io.BytesIO()
        np.lib.format.write_array_header_1_0(made, head)
        made.write(bytes(1 << 20))
        archive.writestr("colour.npy", made.getvalue())
    data = bytearray(path.read_bytes())
    place = data.rfind(b"PK\x01\x02") + 24
    struct.pack_into("<I", data, place, made.tell() - (1 << 20) + int(np.prod(shape)))
    path.write_bytes(data)


def test_arrays_are_measured_before_they_are_unpacked(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    written_zeros(path, (1000, 1024, 1024, 3), zipfile.ZIP_DEFLATED)
    said = told(path)
    assert "it has 3.15 GB, and no more than 250 MB are read" in said
    assert said.endswith("np.savez, which does not compress, leaves them on disk")


def test_a_frame_of_an_archive_is_no_larger_than_a_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.npz"
    np.savez(path, colour=np.zeros((1, 8, 8, 3), np.uint8))
    few = Limit(50, "pixels")
    monkeypatch.setattr("kille.sensors.recordings.npz.PICTURE", few)
    assert "`colour`: it has 64 pixels, and no more than 50" in told(path)


def test_a_mesh_is_no_larger_than_it_may_be(tmp_path: Path) -> None:
    mesh = tmp_path / "a.obj"
    with mesh.open("wb") as file:
        file.truncate(10**9)
    with pytest.raises(SensorError, match="it has 1 GB, and no more than 20 MB"):
        load_scan(mesh)


# --- bags ----------------------------------------------------------------------------


def test_a_chunk_is_unpacked_no_further_than_a_message_may_be(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rosbag1 = pytest.importorskip("rosbags.rosbag1.reader")
    mcap = pytest.importorskip("rosbags.rosbag2.storage_mcap")
    import bz2

    import lz4.frame

    from kille.sensors.recordings.bag_limits import limit_databases
    from ttr.safety.limits import MESSAGE, InputLimitError

    # So that not so much has to be made for it.
    monkeypatch.setattr(type(MESSAGE), "maximum", 1000)
    ways = {"bz2": bz2.compress, "lz4": lz4.frame.compress, "zstd": mcap.zstd.compress}
    with limit_databases():
        unpack = {
            ("bz2", rosbag1.decompressors["bz2"]),
            ("lz4", rosbag1.decompressors["lz4"]),
            ("lz4", lambda data: mcap.DECOMPRESSORS["lz4"](data, 0)),
            ("zstd", lambda data: mcap.DECOMPRESSORS["zstd"](data, 0)),
        }
        for way, one in unpack:
            assert one(ways[way](b"x" * 1000)) == b"x" * 1000
            with pytest.raises(InputLimitError, match="it has more than 1 kB"):
                one(ways[way](bytes(10**6)))


def test_a_record_of_a_bag_is_read_no_further(tmp_path: Path) -> None:
    pytest.importorskip("rosbags")
    bag = tmp_path / "a.bag"
    head = b"#ROSBAG V2.0\n"
    field = struct.pack("<I", 4) + b"op=\x03"
    with bag.open("wb") as file:
        file.write(head + struct.pack("<I", len(field)) + field)
        file.write(struct.pack("<II", 0, 2**31))
        file.truncate(2**32)
    assert "cannot be read" in told(bag)


def test_a_database_runs_nothing_of_its_own(tmp_path: Path) -> None:
    pytest.importorskip("rosbags")
    import apsw

    path = tmp_path / "a.db3"
    with apsw.Connection(str(path)) as database:
        database.execute("CREATE TABLE topics(id, name, type, serialization_format)")
        database.execute("CREATE VIEW messages AS SELECT zeroblob(900000000) AS data")
    assert "this bag cannot be read" in told(path)
