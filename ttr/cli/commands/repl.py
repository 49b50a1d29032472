"""`ttr repl`: a session in which a theory grows line by line."""

from __future__ import annotations

import argparse
from pathlib import Path

from ttr.cli.consent_options import add_allow, consent_of
from ttr.cli.output import FAILED, FINE, Commands, ask, complain, say
from ttr.errors import TTRError
from ttr.safety.limits import InputLimitError


def add(commands: Commands) -> None:
    """Declares the command."""
    repl = commands.add_parser(
        "repl",
        help="type statements and questions, and get answers",
        description="A session in which a theory grows line by line.",
    )
    repl.add_argument("file", nargs="?", metavar="FILE", help="a theory to start from")
    add_allow(repl)
    repl.set_defaults(run=_repl)


def _repl(options: argparse.Namespace) -> int:
    from ttr.cli.session.sessions import Session, load_file
    from ttr.cli.session.terminal import talk
    from ttr.theories.loading import UnreadableError

    session = Session(consent=consent_of(options))
    try:
        if options.file is not None:
            session, _ = load_file(session, Path(options.file))
    except UnreadableError as error:
        return complain(error.message)
    except TTRError as error:
        say(f"error: {error}")
        return FAILED
    try:
        talk(session, say, ask)
    except InputLimitError as error:
        return complain(f"the input cannot be read: {error.strerror}")
    return FINE
