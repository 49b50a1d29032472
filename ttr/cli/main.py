"""The command `ttr`: check a theory file, show what it defines, try things out."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from errno import ENOSPC
from io import TextIOWrapper

from ttr.cli.command_line import Parser, Version
from ttr.cli.commands import COMMANDS
from ttr.cli.output import (
    FAILED,
    INTERRUPTED,
    PIPE_CLOSED,
    complain,
)
from ttr.safety.interruptions import keep_interruptions
from ttr.safety.unforeseen_errors import report_unforeseen


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; 0 fine, 1 something does not hold, 2 wrong use."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # not where a program has replaced it
            stream.reconfigure(errors="backslashreplace")
    try:
        with keep_interruptions():
            code = _run(argv)
        if not sys.stdout.closed:  # as pygls does when an editor says goodbye
            sys.stdout.flush()
    except KeyboardInterrupt:
        return INTERRUPTED
    except RecursionError:
        complain("types are nested too deep, by definitions, to be printed or checked")
        return FAILED
    except BrokenPipeError:
        _drop_output()
        return PIPE_CLOSED
    except Exception as error:
        if not isinstance(error, OSError) or error.errno != ENOSPC:
            return report_unforeseen("ttr", error)
        _drop_output()
        complain("the output cannot be written: no space left on device")
        return FAILED
    return code


def _drop_output() -> None:
    """Python would complain once more when it flushes at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _run(argv: Sequence[str] | None) -> int:
    options = _parser().options_of(argv)
    code: int = options.run(options)
    return code


def _parser() -> Parser:
    parser = Parser(
        prog="ttr",
        description="Type Theory with Records: check files, show them, try things.",
    )
    parser.add_argument("--version", action=Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=Parser)
    for command in COMMANDS:
        command.add(commands)
    return parser


if __name__ == "__main__":
    sys.exit(main())
