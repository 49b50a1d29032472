"""`ttr lsp`: the language server, which editors start."""

from __future__ import annotations

import argparse

from ttr.cli.consent_options import add_allow
from ttr.cli.output import FINE, Commands, complain, step_count
from ttr.safety.budgets import STEPS


def add(commands: Commands) -> None:
    """Declares the command."""
    lsp = commands.add_parser(
        "lsp",
        help="serve an editor: errors as you type, and what names mean",
        description="Speaks the Language Server Protocol on standard input and "
        "output; an editor starts it.",
    )
    add_allow(lsp)
    lsp.add_argument(
        "--steps",
        type=step_count,
        default=STEPS,
        metavar="N",
        help=f"how many steps each check may take (default: {STEPS:,})",
    )
    lsp.set_defaults(run=_serve)


def _serve(options: argparse.Namespace) -> int:
    try:
        from ttr.editing.server import language_server
    except ModuleNotFoundError as missing:
        if (missing.name or "").partition(".")[0] not in ("pygls", "lsprotocol"):
            raise
        return complain("lsp needs pygls: install it by pip install 'kille[editor]'")
    language_server(options.allow, options.steps).start_io()
    return FINE
