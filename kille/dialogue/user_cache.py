"""What was worked out before, kept in the user's cache.

A file is kept for each key. It counts only if it is whole; whatever is wrong with it,
what it should hold is made anew, and where nothing can be written, nothing is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import TypeVar

from platformdirs import user_cache_dir

from ttr import TTRError
from ttr.safety.files import write_whole

MOST = 30
"""How many files are kept in a folder: those that were written last."""

_T = TypeVar("_T")

_DAMAGES = (OSError, ValueError, TypeError, LookupError, AttributeError)
"""What may be raised by a file that is not there, or not as it was written."""


def recall(
    folder: str,
    key: Sequence[str],
    make: Callable[[], _T],
    encode: Callable[[_T], bytes],
    decode: Callable[[bytes], _T],
) -> _T:
    """What `make` gives, from the cache if it is there under the key; else it is kept.

    The key says everything that the result depends on.
    """
    path = cache_folder(folder) / digest(*key)
    try:
        whole, _, body = path.read_bytes().partition(b"\n")
        if whole == _digest_of_bytes(body):
            return decode(body)
    except _DAMAGES:
        pass
    found = make()
    with suppress(OSError, TTRError, TypeError):  # or it is nothing that can be kept
        _keep(encode(found), path)
    return found


def cache_folder(name: str) -> Path:
    """The folder of this name in the user's cache."""
    return Path(user_cache_dir("kille", appauthor=False)) / name


def digest(*texts: str) -> str:
    """A number for some texts, which no other texts have."""
    joined = "\0".join(texts).encode("utf-8", "surrogatepass")
    return sha256(joined).hexdigest()


def _digest_of_bytes(body: bytes) -> bytes:
    return sha256(body).hexdigest().encode()


def _keep(body: bytes, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, _digest_of_bytes(body) + b"\n" + body)
    kept = sorted(path.parent.iterdir(), key=lambda it: it.stat().st_mtime)
    for old in kept[:-MOST]:
        old.unlink()
