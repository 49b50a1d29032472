r"""Words from outside, made safe for where they are shown or written.

Whatever a file, a tutor or a device has named may hold characters that do something
instead of being seen: terminals obey escape codes, browsers obey tags, spreadsheets
compute what begins with `=`. There is one function for each place:

- `terminal_text` for all that is printed, `terminal_line` for what is to stay on one
  line, and `terminal_word` for a name that must not be taken for another;
- `html_text` and `html_address` for pages;
- `csv_line` for tables that spreadsheets open;
- `json_text` for JSON and for the quoted names of the notation.

For LaTeX there is `latex_text` of `ttr.display.latex`, which knows the letters.

What cannot be seen is written as Python would: `\x1b`, `\u202e`. These are the control
characters (C0, DEL, C1), lone surrogates, separators of lines and paragraphs, the
controls of direction, other formatting characters and fillers, and what Unicode has not
assigned. Letters of any script stay as they are, with their marks and in their natural
direction. A joiner or variation selector stays where ordinary spelling has it: between
pictures (👩‍🔬), after a picture (❤️), after a virama, between Arabic letters that join,
in Mongolian, and after an ideograph. Anywhere else it could hide a difference.
"""

from __future__ import annotations

import csv
import io
import json
import re
import unicodedata
from collections.abc import Iterable
from html import escape
from typing import Any
from urllib.parse import quote


def terminal_text(text: str) -> str:
    r"""A text of one line or several, as it may be printed.

    Lines stay lines, and blanks of any width become plain ones. A text that has gone
    through it once stays as it is.

    >>> print(terminal_text("a \x1b[31mcup\n\u202ea\xa0mug"))
    a \x1b[31mcup
    \u202ea mug
    """
    if text.isascii() and not re.search(_ASCII_CONTROLS, text):
        return text
    return _make_visible(text.translate(_PLAIN_BLANKS), "\n")


def terminal_line(text: str) -> str:
    r"""The same on one line: a line feed is made visible too.

    >>> print(terminal_line("a cup\nand a mug"))
    a cup\nand a mug
    """
    return terminal_text(text).replace("\n", r"\n")


def terminal_word(word: str) -> str:
    r"""A name or utterance on one line, which no other looks like.

    Here a line feed and all blanks but the plain one are made visible too, and a
    backslash is doubled: so two words that differ are printed differently, unless
    Unicode itself has two ways to write the same letters.

    >>> print(terminal_word("cup\x07"), terminal_word(r"cup\x07"))
    cup\x07 cup\\x07
    """
    return _make_visible(word.replace("\\", r"\\"), "")


def html_text(text: str) -> str:
    r"""A text for a page: between tags, or in an attribute in quotes.

    It reads as the same text again, except for what cannot be seen, which is written as
    in a terminal. Line feeds, tabs and blanks stay.

    >>> print(html_text('<b onclick="x">Tom & Jerry\x1b</b>'))
    &lt;b onclick=&quot;x&quot;&gt;Tom &amp; Jerry\x1b&lt;/b&gt;
    """
    return escape(_make_visible(text, "\n\t", blanks=True), quote=True)


def html_address(path: str) -> str:
    """The address of a file for a link, from its path as seen from the page.

    A colon, `#`, `?` or `%` in a name is a letter as any other; so no name is a script
    or leads to another machine.

    >>> html_address("javascript:x/50% #1.html"), html_address("//a.org/b")
    ('javascript%3Ax/50%25%20%231.html', '/a.org/b')
    """
    path = re.sub("^//+", "/", path)
    # What stands for bytes that are no UTF-8 becomes these bytes again.
    path = re.sub(
        "[\ud800-\udc7f\udd00-\udfff]", lambda it: _escape_sequence(it[0]), path
    )
    return quote(path.encode("utf-8", "surrogateescape"), safe="/")


def csv_line(cells: Iterable[Any]) -> str:
    """A row of a table, with its line feed, in which a spreadsheet computes nothing.

    A word that begins with `=`, `+`, `-`, `@`, a tab or a carriage return (also after
    blanks, or as a wide letter) gets an apostrophe in front, and so does one that
    begins with apostrophes before these: to read it back, take one apostrophe away.
    Numbers, also those written as words, and all other words stay as they are. A lone
    surrogate, which no file can hold, is written as in a terminal.

    >>> print(csv_line(["=1+1", "cup", -0.5, "-0.5", 'a "cup", red', None]), end="")
    '=1+1,cup,-0.5,-0.5,"a ""cup"", red",
    """
    line = io.StringIO(newline="")
    # A carriage return in a cell is put in quotes only where one ends the lines.
    csv.writer(line, lineterminator="\r\n").writerow(map(_cell, cells))
    return line.getvalue().removesuffix("\r\n") + "\n"


def _cell(cell: Any) -> Any:
    if not isinstance(cell, str):
        return cell
    word = re.sub(_SURROGATES, lambda found: _escape_sequence(found[0]), cell)
    if re.match(_COMPUTED, word) and not _NUMBER.fullmatch(word):
        return f"'{word}"
    return word


def json_text(value: Any, **settings: Any) -> str:
    r"""The value as JSON: letters as they are, what cannot be seen as JSON's escapes.

    The settings are those of `json.dumps`.

    >>> print(json_text(["犬", "\x9b1m", "a\u202eb"]))
    ["犬", "\u009b1m", "a\u202eb"]
    """
    text = json.dumps(value, ensure_ascii=False, **settings)
    if text.isascii() and "\x7f" not in text:
        return text
    return _make_visible(text, "\n\t", written=_json_escape)


# --- what cannot be seen -------------------------------------------------------------


# Patterns are compiled when they are first used, and then known to `re`: most texts are
# plain, and need none of them.
_ASCII_CONTROLS = r"[\x00-\x09\x0b-\x1f\x7f]"
_SURROGATES = "[\ud800-\udfff]"

_BLANKS = "\xa0\u1680\u2000-\u200a\u202f\u205f\u3000"
_PLAIN_BLANKS = {
    **dict.fromkeys((0xA0, 0x1680, *range(0x2000, 0x200B), 0x202F, 0x205F), " "),
    0x3000: "  ",
}

_ODD = (
    # controls, surrogates, separators, blanks
    f"[\x00-\x1f\x7f-\x9f\ud800-\udfff\u2028\u2029{_BLANKS}"
    # printable for Python, but nothing is seen: joiners, fillers, selectors
    "\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u2800\u3164\ufe00-\ufe0f\uffa0"
    "\U00016fe4\U0001d159\U000e0000-\U000e0fff]"
)


def _make_visible(
    text: str, kept: str, *, blanks: bool = False, written: Any = None
) -> str:
    """The text with what cannot be seen written out, except for the kept signs."""
    if text.isprintable() and not re.search(_ODD, text):
        return text
    write = written or _escape_sequence
    flags = {at for found in re.finditer(_FLAGS, text) for at in range(*found.span())}
    return "".join(
        c
        if c in kept
        or at in flags
        or _is_seen(c)
        or (blanks and unicodedata.category(c) == "Zs")
        or _is_spelling(text, at)
        else write(c)
        for at, c in enumerate(text)
    )


def _is_seen(c: str) -> bool:
    return c.isprintable() and not re.match(_ODD, c)


def _escape_sequence(c: str) -> str:
    """A character as Python writes it.

    >>> print(*map(_escape_sequence, "\\n\\x9b\\ue000"))
    \\n \\x9b \\ue000
    """
    code = ord(c)
    if c in "\t\n\r":
        return repr(c)[1:-1]
    if code <= 0xFF:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code <= 0xFFFF else f"\\U{code:08x}"


def _json_escape(c: str) -> str:
    return json.dumps(c)[1:-1]


# --- where ordinary spelling has what cannot be seen ---------------------------------


_NON_JOINER, _JOINER = "\u200c", "\u200d"
_PICTURE = "[©®‼⁉™ℹ↔-↙↩↪⌚-⏿Ⓜ▪▫▶◀◻-◾☀-➿⤴⤵⬅-⬇⬛⬜⭐⭕〰〽㊗㊙\U0001f000-\U0001faff]"
_KEY = "[0-9#*]"
_KEYCAP = "\u20e3"
_PICTURE_FORMS = "\ufe0e\ufe0f"
_FLAGS = (
    "(?<=\U0001f3f4)\U000e0067\U000e0062"
    "(?:\U000e0065\U000e006e\U000e0067|\U000e0073\U000e0063\U000e0074"
    "|\U000e0077\U000e006c\U000e0073)\U000e007f"
)
"""The flags of England, Scotland and Wales: the tags after a black flag."""
_ARABIC = "[\u0620-\u07f5\u0840-\u08ff\ufb50-\ufdff\ufe70-\ufefc]"
_JOINS_NOT_LEFT = ("[\u0621-\u0625\u0627\u0629\u062f-\u0632\u0648\u0671-"
                             "\u0673\u0675-\u0677\u0688-\u0699\u06c0\u06c3-\u06cb\u06cd"
                             "\u06cf\u06d2\u06d3\u06d5\u06ee\u06ef]")  # fmt: skip
_MONGOLIAN = "[\u1820-\u1878\u1880-\u18aa]"
_MONGOLIAN_FORMS = "\u180b\u180c\u180d\u180f"
_MONGOLIAN_SEPARATOR = "\u180e"
_IDEOGRAPH = "[㐀-䶿一-鿿豈-\ufaff\U00020000-\U0003ffff]"
_IDEOGRAPH_FORMS = "[\U000e0100-\U000e01ef]"
_VIRAMA = 9
"""The combining class of the sign that takes away an Indic letter's vowel."""


def _is_spelling(text: str, at: int) -> bool:
    """Is what stands there part of how a word is ordinarily spelt?"""
    c, before, after = text[at], text[at - 1 : at] or " ", text[at + 1 : at + 2] or " "
    if c in _PICTURE_FORMS:
        is_key = bool(re.match(_KEY, before)) and after == _KEYCAP
        return is_key or bool(re.match(_PICTURE, before))
    if c == _JOINER and re.match(_PICTURE, after):
        if before in _PICTURE_FORMS:
            before = text[at - 2 : at - 1] or " "
        return bool(re.match(_PICTURE, before))
    if c in (_JOINER, _NON_JOINER):
        return _shapes_letters(text, at)
    if c in _MONGOLIAN_FORMS:
        return bool(re.match(_MONGOLIAN, before))
    if c == _MONGOLIAN_SEPARATOR:
        return bool(re.match(_MONGOLIAN, before) and re.match(_MONGOLIAN, after))
    return bool(re.match(_IDEOGRAPH_FORMS, c) and re.match(_IDEOGRAPH, before))


def _shapes_letters(text: str, at: int) -> bool:
    """Does a joiner or non-joiner change the shape of the letters around it?"""
    before, after = text[at - 1 : at] or " ", text[at + 1 : at + 2] or " "
    if unicodedata.combining(before) == _VIRAMA:
        return True
    if text[at] == _JOINER:
        is_letter = unicodedata.category(before) == "Lo"
        return is_letter and unicodedata.combining(after) == _VIRAMA
    base = next((c for c in text[at - 1 :: -1] if not unicodedata.combining(c)), " ")
    joins = re.match(_ARABIC, base) and not re.match(_JOINS_NOT_LEFT, base)
    return bool(at and joins and re.match(_ARABIC, after))


# --- how wide it is ------------------------------------------------------------------


def columns(text: str) -> int:
    """How many columns of a terminal a text takes.

    >>> columns("犬"), columns("dog"), columns("e\\u0301")
    (2, 3, 1)
    """
    if text.isascii():
        return len(text)
    return sum(map(_column, text))


def _column(letter: str) -> int:
    if unicodedata.category(letter) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(letter) in "WF" else 1


# --- what a spreadsheet computes -----------------------------------------------------


_COMPUTED = r"'*[\s\ufeff\x00-\x1f]*(?:[=+\-@＝＋－＠]|(?<=[\t\r]))"
_NUMBER = re.compile(r"[+-]?[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?", re.ASCII)
