"""The sockets at which a process can be reached by others, as Linux lists them.

They are TCP sockets that listen, UDP sockets that take what anybody sends, and Unix
sockets with a name. A pair of sockets without names is none of these: nobody can open
it who was not handed one of its ends.
"""

from __future__ import annotations

import os
import socket
import struct
from collections.abc import Iterable, Iterator
from contextlib import suppress
from ipaddress import ip_address
from pathlib import Path
from typing import NamedTuple

__all__ = ["Listening", "reach_of", "sockets_of", "tree"]

PROC = Path("/proc")
USER, MACHINE, NETWORK = "the user", "this machine", "the network"
"""Who can reach a socket: nobody but the user, any user of the machine, or anybody."""

_LISTENS, _UNCONNECTED = "0A", "07"
_ACCEPTS, _DATAGRAMS = 0x10000, "0002"


class Listening(NamedTuple):
    """A socket with its address, and who can reach it."""

    kind: str
    address: str
    reach: str


def tree(process: int) -> set[int]:
    """A process and all that descend from it."""
    parents = dict(_parents())
    found = {process}
    while more := {it for it, parent in parents.items() if parent in found} - found:
        found |= more
    return found


def _parents() -> Iterator[tuple[int, int]]:
    for it in PROC.glob("[0-9]*/stat"):
        with suppress(OSError):
            yield int(it.parent.name), int(it.read_text().rpartition(")")[2].split()[1])


def sockets_of(processes: Iterable[int]) -> set[Listening]:
    """Where these processes can be reached, as far as they still run."""
    return {it for process in processes for it in _sockets_of(process)}


def _sockets_of(process: int) -> Iterator[Listening]:
    opened = set(_opened(process))
    if not opened:
        return
    for kind in ("tcp", "tcp6", "udp", "udp6", "udplite", "udplite6"):
        for row in _table(process, kind):
            if row[9] in opened and row[3] == _state(kind):
                yield _of_internet(kind, row[1])
    for row in _table(process, "unix"):
        name = row[7] if len(row) > 7 else ""
        accepts = int(row[3], 16) & _ACCEPTS
        if row[6] in opened and (accepts or (name and row[4] == _DATAGRAMS)):
            yield Listening("unix", name, reach_of(name))


def _state(kind: str) -> str:
    return _LISTENS if kind.startswith("tcp") else _UNCONNECTED


def _opened(process: int) -> Iterator[str]:
    """The inodes of all sockets that a process has."""
    with suppress(OSError):
        for it in (PROC / str(process) / "fd").iterdir():
            with suppress(OSError):
                kind, _, number = os.readlink(it).partition(":")
                if kind == "socket":
                    yield number[1:-1]


def _table(process: int, kind: str) -> list[list[str]]:
    with suppress(OSError):
        lines = (PROC / str(process) / "net" / kind).read_text().splitlines()
        return [line.split(maxsplit=11) for line in lines[1:]]
    return []


def _of_internet(kind: str, written: str) -> Listening:
    digits, port = written.split(":")
    words = [digits[at : at + 8] for at in range(0, len(digits), 8)]
    packed = b"".join(struct.pack("=I", int(it, 16)) for it in words)
    family = socket.AF_INET if len(packed) == 4 else socket.AF_INET6
    address = socket.inet_ntop(family, packed)
    return Listening(kind, f"{address} port {int(port, 16)}", reach_of(address))


def reach_of(address: str) -> str:
    """Who can reach an address of the internet, or a name in the file system.

    >>> [reach_of(it) for it in ("0.0.0.0", "::", "127.0.0.1", "::1", "@abstract")]
    ['the network', 'the network', 'this machine', 'this machine', 'this machine']
    """
    with suppress(ValueError):
        return MACHINE if ip_address(address).is_loopback else NETWORK
    if not address.startswith("/"):
        return MACHINE
    return MACHINE if _may_others(Path(address)) else USER


def _may_others(path: Path) -> bool:
    """May others than its owner write to a socket, and enter all folders above it?"""
    try:
        folders = [it.stat().st_mode & 0o011 for it in path.parents]
        return bool(path.stat().st_mode & 0o022) and all(folders)
    except OSError:
        return False
