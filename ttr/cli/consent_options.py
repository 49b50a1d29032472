"""The options by which a user consents to what files name: folders, and Python."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ttr.safety.consent import Consent

if TYPE_CHECKING:
    from ttr.dialogues.stories import Setting


def add_allow(command: argparse.ArgumentParser) -> None:
    """Declares `--allow`, by which files may use what lies in other folders, too."""
    command.add_argument(
        "--allow",
        action="append",
        type=_folder,
        default=[],
        metavar="FOLDER",
        help="files may also use what lies in this folder or below, besides their own; "
        "may be repeated",
    )


def add_consent(command: argparse.ArgumentParser, log: str = "") -> None:
    """Declares `--allow`, and `--no-python`, by which no Python of a file is run.

    Where a log may name Python, called so, also `--trust`, by which that is run. Of the
    two, one alone can be meant.
    """
    add_allow(command)
    either = command.add_mutually_exclusive_group()
    either.add_argument(
        "--no-python", action="store_true", help="refuse what names Python"
    )
    if log:
        either.add_argument(
            "--trust", action="store_true", help=f"run the Python that {log} names"
        )


def consent_of(options: argparse.Namespace) -> Consent:
    """What the user consents to by these options, whichever of them there are."""
    return Consent.of(
        getattr(options, "allow", ()), python=not getattr(options, "no_python", False)
    )


def named_game(reference: str, consent: Consent) -> Setting:
    """A game that the user has named, from the working directory; raises `TTRError`."""
    from ttr.dialogues.stories import named_by_user, setting

    return setting(reference, Path(), named_by_user(reference, Path(), consent))


def _folder(text: str) -> Path:
    if Path(text).is_dir():
        return Path(text)
    raise argparse.ArgumentTypeError(f"there is no folder {text}")
