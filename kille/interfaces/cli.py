"""The command `kille`. What needs the camera or the parser is imported when it runs."""

from __future__ import annotations

import argparse
import difflib
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

__all__ = ["main"]

FINE, FAILED, WRONG_USE, INTERRUPTED, PIPE_CLOSED = 0, 1, 2, 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; 0 fine, 1 failed, 2 wrong use, 130 after Ctrl-C."""
    try:
        code = _run(argv)
        sys.stdout.flush()
    except KeyboardInterrupt:
        sys.stderr.write("\n")
        return INTERRUPTED
    except BrokenPipeError:
        # Python would complain once more when it flushes at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE_CLOSED
    return code


def _run(argv: Sequence[str] | None) -> int:
    options = _parser().parse_args(argv)
    code: int = options.run(options)
    return code


class _Parser(argparse.ArgumentParser):
    """A parser whose complaint is one line, with a way out."""

    def error(self, message: str) -> NoReturn:
        found = message.partition("invalid choice: ")[2].split("'")
        if len(found) > 2:
            known = found[3::2]
            near = difflib.get_close_matches(found[1], known, n=1)
            way_out = f"did you mean {near[0]}?" if near else f"try {', '.join(known)}"
            message = f"there is no {found[1]}: {way_out}"
        self.exit(WRONG_USE, f"{self.prog}: {message} ({self.prog} --help says more)\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="kille",
        description="A table-top robot that learns words for objects and places.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(
        metavar="COMMAND", required=True, parser_class=_Parser
    )
    demo = commands.add_parser("demo", help="watch a tutor teach and test the robot")
    demo.add_argument("--seed", type=int, default=7, help="another run of chance")
    demo.add_argument(
        "--out",
        type=Path,
        default=Path("kille-demo.png"),
        metavar="FILE",
        help="where the picture sheet goes (kille-demo.png)",
    )
    demo.set_defaults(run=_demo)
    talk = commands.add_parser("talk", help="teach the robot yourself")
    talk.add_argument(
        "--sensor",
        default="synthetic",
        metavar="S",
        help="what it looks through: synthetic, synthetic:SCENE?seed=7, or the path "
        "of recorded captures",
    )
    talk.add_argument(
        "--memory",
        type=Path,
        metavar="FILE",
        help="where it keeps what it learns (your data folder)",
    )
    talk.add_argument("--lang", choices=["en"], default="en", help="language")
    talk.add_argument("--trace", action="store_true", help="show the judgements")
    talk.set_defaults(run=_talk)
    replay = commands.add_parser("replay", help="play dialogue files, compare answers")
    replay.add_argument("files", nargs="+", type=Path, metavar="FILE.dlg")
    replay.add_argument("--quiet", action="store_true", help="only what differs")
    replay.set_defaults(run=_replay)
    memory = commands.add_parser("memory", help="what the robot has learned")
    actions = memory.add_subparsers(
        metavar="ACTION", required=True, parser_class=_Parser
    )
    listing = actions.add_parser(
        "list", help="the words, and how often each was taught"
    )
    listing.add_argument("--memory", type=Path, metavar="FILE", help="which memory")
    listing.add_argument("--json", action="store_true", help="report for machines")
    listing.set_defaults(run=_memory_list)
    doctor = commands.add_parser("doctor", help="what works here, what is missing")
    doctor.add_argument("--json", action="store_true", help="report for machines")
    doctor.set_defaults(run=_doctor)
    return parser


class _Version(argparse.Action):
    """Prints the version, which is looked up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import version

        sys.stdout.write(f"kille {version('kille')}\n")
        parser.exit()


def _demo(options: argparse.Namespace) -> int:
    from kille.interfaces.demo import demo

    return demo(options.seed, options.out)


def _talk(options: argparse.Namespace) -> int:
    from kille.interfaces.talk import talk

    return talk(options.sensor, options.memory, trace=options.trace)


def _replay(options: argparse.Namespace) -> int:
    from kille.interfaces.replay import replay

    return replay(options.files, quiet=options.quiet)


def _memory_list(options: argparse.Namespace) -> int:
    from kille.interfaces.memory import list_words

    return list_words(options.memory, as_json=options.json)


def _doctor(options: argparse.Namespace) -> int:
    from kille.interfaces.doctor import doctor

    return doctor(as_json=options.json)


if __name__ == "__main__":
    sys.exit(main())
