"""Words from outside: whatever they hold, they are seen and do nothing else."""

from __future__ import annotations

import csv
import io
import json
import re
import unicodedata
from html.parser import HTMLParser
from urllib.parse import unquote_to_bytes, urlsplit

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from ttr.display.latex import latex_text
from ttr.errors import Span, TTRError
from ttr.escapes import (
    columns,
    csv_line,
    html_address,
    html_text,
    json_text,
    terminal_line,
    terminal_text,
    terminal_word,
)
from ttr.notation.reader import parse
from ttr.types.printing import notation

HOSTILE = (
    "\x1b]0;pwned\x07",
    "\x1b[31mcup\x9b1m",
    "\r\x08\x7fcup",
    "\u202egrab\u202c\u2066\u200e\u061c",
    "cu\u200bp\ufeff\u00ad\u2060",
    "a\u2028b\u2029c\x85d",
    "\ud800\udc00\udfff",
    "\U000e0041\U000e0042\u3164\u2800\u115f",
    "</pre><script>alert(1)</script>",
    "\" onmouseover='x' <!-- ]]>",
    "javascript:alert(1)",
    "=cmd|' /C calc'!A0",
    "'=1+1",
    "\\input{/etc/passwd}^^5c$a$%#&_~{}",
    "[bold red]cup[/] $x_1$ :smile:",
    "cup\x00mug",
)
ORDINARY = (
    "cup",
    "can of paint",
    "naïve café",
    "e\u0301a\u0308",
    "שָׁלוֹם",
    "مَرْحَبًا",
    "می\u200cخواهم",
    "क्\u200dष",
    "ශ්\u200dරී",
    "র\u200d্য",
    "犬葛\U000e0100城",
    "ᠬᠠᠷ\u180eᠠ",
    "❤\ufe0f☎\ufe0e",
    "1\ufe0f\u20e3",
    "👩\u200d👩\u200d👧\u200d👦",
    "🏴\U000e0067\U000e0062\U000e0065\U000e006e\U000e0067\U000e007f",
    "🏳\ufe0f\u200d🌈👨🏽\u200d🔬🇸🇪",
    "-0.5",
)
AROUND = st.sampled_from(
    "a ا د犬क्❤😀0\u20e3\u200c\u200d\ufe0f\ufe0e\U000e0067\U000e0100\u180b\u180e\\x1bn"
)
"""Signs whose meaning depends on what stands beside them."""
texts = st.text() | st.text(AROUND) | st.sampled_from(HOSTILE + ORDINARY)
"""Over all of Unicode, with lone surrogates."""

every = pytest.mark.parametrize("word", ORDINARY, ids=ascii)


# --- a terminal ----------------------------------------------------------------------


def obeyed(text: str) -> list[str]:
    """What of a text a terminal would obey, or not show, if it is no joiner."""
    return [
        c
        for c in text
        if not c.isprintable() and c not in "\u200c\u200d\u180e" and not _is_tag(c)
    ]


def _is_tag(c: str) -> bool:
    return "\U000e0061" <= c <= "\U000e007f"


@given(texts)
def test_a_terminal_is_told_nothing(text: str) -> None:
    assert obeyed(terminal_text(text).replace("\n", "")) == []
    assert obeyed(terminal_line(text)) == []
    assert obeyed(terminal_word(text)) == []


def test_no_character_of_unicode_is_obeyed() -> None:
    every = filter(is_assigned, map(chr, range(0x110000)))
    shown = {c: terminal_text(c) for c in every if not c.isprintable()}
    assert {c for c, seen in shown.items() if obeyed(seen)} == {"\n"}
    blank = [c for c, seen in shown.items() if not seen.strip() and c != "\n"]
    assert {unicodedata.category(c) for c in blank} == {"Zs"}


def is_assigned(c: str) -> bool:
    return unicodedata.category(c) not in ("Cn", "Co")


@given(texts)
def test_what_is_shown_once_is_shown_so_for_good(text: str) -> None:
    shown = terminal_text(text)
    assert terminal_text(shown) == shown
    assert terminal_line(shown) == terminal_line(text)


@given(texts)
def test_each_line_stays_a_line(text: str) -> None:
    assert terminal_text(text).count("\n") == text.count("\n")
    assert len(terminal_line(text).splitlines()) <= 1


_BACK = re.compile(
    r"\\(?:(\\)|x([0-9a-f]{2})|u([0-9a-f]{4})|U([0-9a-f]{8})|([tnr]))", re.DOTALL
)


def read_back(shown: str) -> str:
    """The word that is shown so."""

    def one(found: re.Match[str]) -> str:
        slash, *codes, letter = found.groups()
        code = next(filter(None, codes), "")
        if code:
            return chr(int(code, 16))
        return slash or {"t": "\t", "n": "\n", "r": "\r"}[letter]

    return _BACK.sub(one, shown)


@given(texts)
@example("\\x1b")
@example("\x1b")
@example("\\\\n")
def test_no_two_words_are_shown_alike(word: str) -> None:
    assert read_back(terminal_word(word)) == word


@every
def test_ordinary_words_stay_as_they_are(word: str) -> None:
    assert terminal_word(word) == terminal_text(word) == html_text(word) == word
    assert csv_line([word]) == f"{word}\n"
    assert json_text(word) == f'"{word}"'


@pytest.mark.parametrize(
    ("word", "shown"),
    [
        ("a\u200db", r"a\u200db"),
        ("د\u200cا", r"د\u200cا"),
        ("a\ufe0f", r"a\ufe0f"),
        ("😀\u200d\u200d😀", r"😀\u200d\u200d😀"),
        ("x\ufe0f\u200d😀", r"x\ufe0f\u200d😀"),
        ("1\ufe0f", r"1\ufe0f"),
        ("🏴\U000e0061\U000e0062", r"🏴\U000e0061\U000e0062"),
        ("犬\u200d", r"犬\u200d"),
    ],
)
def test_a_joiner_that_joins_nothing_is_seen(word: str, shown: str) -> None:
    assert terminal_word(word) == shown


def test_blanks_are_blank_in_a_text_and_told_apart_in_words() -> None:
    assert terminal_text("a\xa0b\u3000c") == "a b  c"
    assert terminal_word("a\xa0b\u3000c") == r"a\xa0b\u3000c"


# --- errors --------------------------------------------------------------------------


@given(st.text(max_size=100).map(lambda text: text.replace("\n", "")), st.data())
@example("犬 \x1b[31mcup", None)
def test_the_mark_stands_below_what_it_marks(text: str, data: st.DataObject) -> None:
    first, last = 0, len(text)
    if data is not None:
        first = data.draw(st.integers(0, len(text)))
        last = data.draw(st.integers(first + 1, len(text) + 1))
    shown = str(Span.of("a.ttr", text, first, last))
    _, line, below = shown.split("\n")
    start = columns(terminal_line(text[:first].replace("\t", " ")))
    wide = columns(terminal_line(text[first:last].replace("\t", " ")))
    assert below == f"  │ {' ' * start}{'^' * max(1, wide)}"
    assert obeyed(line) == []


def test_a_long_line_is_marked_where_it_is_shown() -> None:
    text = "犬\x1b" * 100 + "cup" + "\x07" * 100
    _, line, below = str(Span.of("a.ttr", text, 200, 203)).split("\n")
    at = line.index("cup")
    assert below.index("^") == columns(line[:at])
    assert below.count("^") == 3


@given(texts, texts)
def test_an_error_is_safe_to_print(message: str, hint: str) -> None:
    span = Span.of(message, hint, 0, 1)
    shown = str(TTRError(message, span=span, hint=hint))
    assert obeyed(shown.replace("\n", "")) == []


# --- pages ---------------------------------------------------------------------------


class Read(HTMLParser):
    """What a browser makes of a piece of a page: text, and the tags that it opens."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=True)
        self.text, self.tags = "", list[tuple[str, list[tuple[str, str | None]]]]()
        self.others = list[str]()
        self.feed(page)
        self.close()

    def handle_data(self, data: str) -> None:
        self.text += data

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, attrs))

    def handle_comment(self, data: str) -> None:
        self.others.append(data)

    def handle_decl(self, decl: str) -> None:
        self.others.append(decl)

    def handle_pi(self, data: str) -> None:
        self.others.append(data)

    def unknown_decl(self, data: str) -> None:
        self.others.append(data)


@given(texts)
def test_a_page_shows_the_word_and_opens_nothing(word: str) -> None:
    page = (
        f"<p title=\"{html_text(word)}\" id='{html_text(word)}'>{html_text(word)}</p>"
    )
    read = Read(page)
    ((tag, attributes),) = read.tags
    assert (tag, [name for name, _ in attributes]) == ("p", ["title", "id"])
    assert read.others == []
    seen = read.text
    assert {value for _, value in attributes} == {seen}
    assert obeyed(re.sub(r"[\n\t]", "", "".join(seen.split()))) == []
    if not obeyed(word) and terminal_word(word) == word.replace("\\", r"\\"):
        assert seen == word
    page.encode("utf-8")


@given(texts)
def test_a_link_leads_to_the_file_and_nowhere_else(name: str) -> None:
    address = html_address(name)
    assert html_text(address) == address
    parts = urlsplit(address)
    assert parts._replace(path="") == ("",) * 5
    if not re.search("[\ud800-\udfff]", name):
        back = unquote_to_bytes(address).decode("utf-8")
        assert back == re.sub("^//+", "/", name)


# --- tables --------------------------------------------------------------------------


def reread(cell: object) -> str:
    table = csv_line(["run", cell, 1]) * 2
    (_, found, _), _ = csv.reader(io.StringIO(table, newline=""))
    return found


def without_apostrophe(found: str) -> str:
    guarded = re.match(r"'+[\s\ufeff\x00-\x1f]*(?:[=+\-@＝＋－＠]|(?<=[\t\r]))", found)
    return found[1:] if guarded else found


@given(texts)
@example("=1")
@example("'=1")
@example("\t")
@example("\r\n=1")
@example("\ufeff=1")
def test_a_table_holds_the_word_and_computes_nothing(word: str) -> None:
    found = reread(word)
    if not re.fullmatch(r"[+-]?[0-9.]+([eE][+-]?[0-9]+)?", word, re.ASCII):
        assert found[:1] not in set("=+-@\t\r＝＋－＠")
        assert found.lstrip()[:1] not in set("=+-@＝＋－＠")
    if not re.search("[\ud800-\udfff]", word):
        assert without_apostrophe(found) == word
    found.encode("utf-8")


@given(st.floats(allow_nan=False) | st.integers())
def test_numbers_stay_numbers(number: float) -> None:
    assert csv_line([number, "a", None]) == f"{number!r},a,\n"
    assert type(number)(reread(number)) == number
    if "inf" not in repr(number):
        assert csv_line([repr(number)]) == f"{number!r}\n"


def test_ordinary_tables_are_the_same_bytes() -> None:
    rows = [["cup", 1, -0.5, None, "", 'a "mug", red\nblue'], ["犬"], [""]]
    file = io.StringIO(newline="")
    csv.writer(file, lineterminator="\n").writerows(rows)
    assert "".join(map(csv_line, rows)) == file.getvalue()


# --- JSON and the notation -----------------------------------------------------------


@given(texts, st.none() | st.integers(0, 2))
def test_json_reads_back_and_is_safe_to_print(word: str, indent: int | None) -> None:
    text = json_text({word: [word, 1]}, indent=indent)
    assert obeyed(text.replace("\n", "")) == []
    assert terminal_text(text) == text
    if not re.search("[\ud800-\udbff][\udc00-\udfff]", word):
        assert json.loads(text) == {word: [word, 1]}


@given(texts)
def test_a_name_in_the_notation_reads_back(word: str) -> None:
    text = f"{{x = {notation(word)}}}"
    assert obeyed(text) == []
    pairs = re.search("[\ud800-\udbff][\udc00-\udfff]", word)
    if '"' in text and not pairs:
        assert parse(text)["x"] == word  # type: ignore[index]


# --- LaTeX ---------------------------------------------------------------------------


COMMANDS = re.compile(
    "mathrm|mathit|textit|text|backslash|wedge|sim|bullet|times|le|ge|to|vee|neg"
    "|sqsubseteq"
)
"""What we write; none of it reads or writes a file, or defines anything."""


@given(texts, st.sampled_from((None, "type", "label", "object", "text")))
@example("\\input{a}", None)
@example("\\input{a}", "type")
@example("^^5cinput", None)
@example("}\\write18{ls}%", "object")
def test_latex_sets_the_word_and_obeys_nothing(word: str, role: object) -> None:
    text = latex_text(word, role)  # type: ignore[arg-type]
    assert all(map(COMMANDS.fullmatch, re.findall(r"\\([A-Za-z]+)", text)))
    assert set(re.findall(r"\\([^A-Za-z])", text)) <= set("_%&#${}")
    left = re.sub(r"\\(?:[A-Za-z]+|.)", "", text, flags=re.DOTALL)
    assert not set("%&#$~_") & set(left), "active, a comment, or mathematics"
    assert "^^" not in left
    depth = 0
    for brace in re.findall(r"[{}]", left):
        depth += 1 if brace == "{" else -1
        assert depth >= 0
    assert depth == 0
    assert obeyed(text) == []
