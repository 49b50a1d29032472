"""The command `kille`. What needs the camera or the parser is imported when it runs."""

from __future__ import annotations

import argparse
import difflib
import os
import re
import sys
from collections.abc import Sequence
from io import StringIO, TextIOWrapper
from pathlib import Path
from typing import Any, NoReturn

__all__ = ["main"]

FINE, FAILED, WRONG_USE, INTERRUPTED, PIPE_CLOSED = 0, 1, 2, 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; 0 fine, 1 failed, 2 wrong use, 130 after Ctrl-C."""
    _prepare_streams()
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
    options, unknown = _parser().parse_known_args(argv)
    if unknown:
        options.parser.error(f"unknown option: {unknown[0]}")
    if "run" not in options:
        options.parser.error("a command is missing")
    code: int = options.run(options)
    return code


def _prepare_streams() -> None:
    """Have something to read and write even where a caller has closed it.

    Bytes that are no characters, and characters that cannot be shown, are replaced.
    """
    for name in ("stdin", "stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, StringIO())
        elif isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")


class _Parser(argparse.ArgumentParser):
    """A parser whose complaint is one line, with a way out."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)
        self.set_defaults(parser=self)

    def error(self, message: str) -> NoReturn:
        message = self._with_way_out(message)
        self.exit(WRONG_USE, f"{self.prog}: {message} ({self.prog} --help says more)\n")

    def _with_way_out(self, message: str) -> str:
        if found := re.search(r"invalid choice: '(.*)' \(choose from (.*)\)", message):
            known = re.findall(r"[\w-]+", found[2])
            return _no_such(found[1], known, f"try {', '.join(known)}")
        if found := re.fullmatch(r"unknown option: ([^=]*).*", message, re.DOTALL):
            options = re.findall(r"--[\w-]+", self.format_help())
            return _no_such(found[1], options, "it is not understood here")
        return message


def _no_such(word: str, known: Sequence[str], otherwise: str) -> str:
    near = difflib.get_close_matches(word, known, n=1)
    return f"there is no {word}: {f'did you mean {near[0]}?' if near else otherwise}"


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="kille",
        description="A table-top robot that learns words for objects and places.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=_Parser)
    demo = commands.add_parser("demo", help="watch a tutor teach and test the robot")
    demo.add_argument(
        "--seed", type=_seed, default=7, metavar="N", help="another run of chance (7)"
    )
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
    telling = replay.add_mutually_exclusive_group()
    telling.add_argument("--quiet", action="store_true", help="only what differs")
    telling.add_argument("--json", action="store_true", help="report for machines")
    replay.add_argument(
        "--junit", type=Path, metavar="FILE", help="write a report for CI (.xml)"
    )
    replay.set_defaults(run=_replay)
    memory = commands.add_parser("memory", help="what the robot has learned")
    actions = memory.add_subparsers(metavar="ACTION", parser_class=_Parser)
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


def _seed(text: str) -> int:
    if text.isascii() and text.isdigit():
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no whole number from 0, such as 7")


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
    from kille.interfaces.showing import derivation, nothing
    from kille.interfaces.talk import talk

    account = derivation if options.trace else nothing
    return talk(options.sensor, options.memory, account)


def _replay(options: argparse.Namespace) -> int:
    from kille.interfaces.replay import as_json, in_brief, in_full, replay

    report = in_brief if options.quiet else in_full
    return replay(options.files, as_json if options.json else report, options.junit)


def _memory_list(options: argparse.Namespace) -> int:
    from kille.interfaces.memory import as_json, as_table, list_words

    return list_words(options.memory, as_json if options.json else as_table)


def _doctor(options: argparse.Namespace) -> int:
    from kille.interfaces.doctor import as_json, as_text, doctor

    return doctor(as_json if options.json else as_text)


if __name__ == "__main__":
    sys.exit(main())
