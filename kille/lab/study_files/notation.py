"""Why a text is no TOML, told to who has never heard of it."""

from __future__ import annotations

import re

_SEE = "see https://toml.io"

_SLIPS = (
    (re.compile("=\\s*[“”„«»‘’]"), 'a text is put between straight quotes, "…"'),
    (re.compile(r"=\s*(True|False)\b"), "write true or false, in small letters"),
    (re.compile(r"=\s*(?!(true|false|nan|inf)\b)[^\W\d]"), 'a text has quotes, "…"'),
    (re.compile(r"=\s*\.\d"), "a number begins with a digit, 0.1"),
    (re.compile(r"=\s*\d+,\d+"), "a number has a point, 0.1"),
    (re.compile(r"^\s*[\w-]+\s*:"), "write KEY = VALUE"),
)
"""What somebody has probably written on a line that is wrong, and what to write."""


def why_not_toml(text: str, error: Exception) -> tuple[int, str]:
    """On which line of a text, and why, it is no TOML.

    Python 3.11 has the place of a mistake only in its message.
    """
    what, _, place = str(error).partition(" (at ")
    lines = text.split("\n")
    found = re.search(r"line (\d+)", place)
    number = int(found[1]) if found else text.removesuffix("\n").count("\n") + 1
    line = lines[number - 1] if number <= len(lines) else ""
    return number, f"this is no TOML: {_plain(what, line, text)}"


def _plain(what: str, line: str, text: str) -> str:
    """What the reader says, in the words of who writes, and a way out."""
    if what == "Cannot overwrite a value" and "=" in line:
        return f"{line.partition('=')[0].strip()} is there twice"
    header = re.match(r"\s*\[+\s*([^\]]+?)\s*\]", line)
    if header and what.startswith("Cannot "):
        return _again(header[1], text)
    if what.startswith("Cannot mutate"):
        return "it adds to what is whole, between { and }: write it in there"
    slips = (hint for slip, hint in _SLIPS if slip.search(line))
    return f"{what[:1].lower()}{what[1:]}; {next(slips, _SEE)}"


def _again(table: str, text: str) -> str:
    """That a table is there twice, or once as one of several and once alone."""
    several = f"[[{table}]]"
    if several in text:
        return f"[{table}] is there beside {several}: write {several} each time"
    return f"[{table}] is there twice"
