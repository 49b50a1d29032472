"""The command `ttr`: one module for each of its `commands`, and the `session`.

May import: all other rooms.
"""
