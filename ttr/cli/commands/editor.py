"""`ttr editor`: writes what editors need to show theories and stories."""

from __future__ import annotations

import argparse
from pathlib import Path

from ttr.cli.output import FINE, Commands, complain, say
from ttr.errors import TTRError
from ttr.safety.files import write_whole


def add(commands: Commands) -> None:
    """Declares the command."""
    editor = commands.add_parser(
        "editor",
        help="write what an editor needs",
        description="Writes the extension for Visual Studio Code (vscode, a .vsix), "
        "the syntax of theories for Vim and Neovim (vim, a .vim), modes for Emacs "
        "(emacs, an .el), or the TextMate grammar of theories (ttr) or stories (dlg).",
    )
    editor.add_argument("what", choices=["vscode", "vim", "emacs", "ttr", "dlg"])
    editor.add_argument("file", type=Path, metavar="FILE", help="the file to write")
    editor.set_defaults(run=_write)


def _write(options: argparse.Namespace) -> int:
    from ttr.editing.emacs_mode import emacs_mode
    from ttr.editing.textmate import GRAMMARS, grammar_text
    from ttr.editing.vim_syntax import vim_syntax
    from ttr.editing.vscode_package import vscode_package

    try:
        if options.what == "vscode":
            write_whole(options.file, vscode_package())
            say(f"{options.file} is written: code --install-extension {options.file}")
        elif options.what in ("vim", "emacs"):
            write_whole(
                options.file, vim_syntax() if options.what == "vim" else emacs_mode()
            )
            say(f"{options.file} is written")
        else:
            grammar = GRAMMARS[f"{options.what}.tmLanguage.json"]()
            write_whole(options.file, grammar_text(grammar))
            say(f"{options.file} is written")
    except TTRError as error:
        return complain(error.message)
    return FINE
