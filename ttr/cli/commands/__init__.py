"""The commands of `ttr`: one module each, which does its work when it is asked to.

Every module has `add(commands)`, which declares the command's arguments. It imports
what it needs only when the command runs, so that `ttr --help` is fast.
"""

from ttr.cli.commands import check, editor, fracas, lsp, play, repl, replay, show, test

#: In the order of the help text.
COMMANDS = (check, play, replay, test, show, repl, lsp, editor, fracas)
