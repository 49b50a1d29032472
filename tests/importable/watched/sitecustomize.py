"""Has every Python process tell of itself, and of each socket that it gives an address.

Python loads this when it starts, in a process whose PYTHONPATH names this folder. What
is told goes into the file that WATCHED names, one line of JSON each. A socket cannot be
too short-lived to be told of; those of libraries in C are told of if they are there at
the end.
"""

import atexit
import json
import os
import sys

FILE = os.environ.get("WATCHED")


def tell(what: str, told: object) -> None:
    """Adds a line."""
    line = json.dumps([os.getpid(), what, told])
    file = os.open(str(FILE), os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)
    os.write(file, f"{line}\n".encode())
    os.close(file)


def hear(event: str, given: tuple[object, ...]) -> None:
    """Tells of an address that a socket is given, and of programs that are started."""
    if event == "socket.bind":
        tell("bound", str(given[1]))


def last() -> None:
    """Tells of all sockets that there are at the end."""
    from listening import sockets_of

    for it in sockets_of([os.getpid()]):
        tell("listened", [*it])


if FILE:
    tell("began", sys.orig_argv)
    sys.addaudithook(hear)
    os.register_at_fork(after_in_child=lambda: tell("forked", []))
    atexit.register(last)
