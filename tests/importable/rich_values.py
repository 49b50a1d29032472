"""What the HTML and the LaTeX of every value have to be like."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from xml.etree import ElementTree

HOSTILE = "<script>alert('1')</script>\"&\u202e"
"""A name that would do something if it were not escaped."""

LARGEST = 400_000
"""How many letters the HTML of any value has at most, pictures aside."""

_VOID = {"img", "br"}


class _Tags(HTMLParser):
    """The tags of a page, each closed in its turn."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def check_html(html: str) -> None:
    """It is well-formed, escaped, self-contained and of bounded size."""
    ElementTree.fromstring(html)
    tags = _Tags()
    tags.feed(html)
    assert tags.open == []
    names = [name for name, _ in tags.seen]
    assert names.count("style") == 1
    assert not {"script", "iframe", "object", "embed", "link", "svg"} & {*names}
    for _, attributes in tags.seen:
        assert not any(name.startswith("on") for name in attributes)
        assert "href" not in attributes
        assert (attributes.get("src") or "data:image/").startswith("data:image/")
    assert "url(" not in html
    assert "@import" not in html
    assert "\u202e" not in html
    assert len(re.sub(r'src="[^"]*"', "", html)) < LARGEST


MACROS = {
    "backslash", "begin", "bullet", "end", "kern", "lambda", "langle", "le", "left",
    "mathit", "mathord", "mathrm", "neg", "phantom", "rangle", "right", "sim",
    "sqsubseteq", "surd", "text", "textit", "times", "to", "underline", "vee",
    "vphantom", "wedge", "ge",
}  # fmt: skip
"""What plain LaTeX with amsmath, MathJax 2 and 3 and KaTeX all know."""


def check_latex(drawn: str) -> None:
    """It uses only what its readers know, and closes what it opens."""
    assert {*re.findall(r"\\([a-zA-Z]+)", drawn)} <= MACROS
    plain = re.sub(r"\\text(?:it)?\{[^{}\\]*\}|\\[_%&#${}]", "", drawn)
    assert not {*"%#$~`\"'"} & {*plain.removeprefix("$").removesuffix("$")}
    opened: list[str] = []
    closes = {"\\right": "\\left", "\\end": "\\begin", "}": "{"}
    for sign in re.findall(r"\\left|\\right|\\begin|\\end|[{}]", plain):
        if sign in closes:
            assert opened.pop() == closes[sign]
        else:
            opened.append(sign)
    assert opened == []
