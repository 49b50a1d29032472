"""Elements of pages, in which every text is escaped unless it is markup already."""

from __future__ import annotations

from collections.abc import Iterable

from ttr.escapes import html_text

_VOID = frozenset({"img"})


class Markup(str):
    """A piece of a page, which is not escaped any more."""

    __slots__ = ()

    def __add__(self, other: str) -> Markup:
        return join((self, other))


NOTHING = Markup("")


def join(parts: Iterable[str]) -> Markup:
    """Join texts and pieces of a page to one piece.

    >>> join(["a < b", Markup("<br>")])
    'a &lt; b<br>'
    """
    return Markup(
        "".join(it if isinstance(it, Markup) else html_text(it) for it in parts)
    )


def element(tag: str, *content: str, **attributes: str) -> Markup:
    """An element of a page; attributes without a value are left out.

    >>> element("a", "Tom & Jerry", href="#it's", class_="")
    '<a href="#it&#x27;s">Tom &amp; Jerry</a>'
    """
    given = "".join(
        f' {name.rstrip("_").replace("_", "-")}="{html_text(value)}"'
        for name, value in attributes.items()
        if value
    )
    end = "" if tag in _VOID else f"</{tag}>"
    return Markup(f"<{tag}{given}>{join(content)}{end}")


def link(text: str, address: str) -> Markup:
    """A link; without an address, the text alone."""
    return element("a", text, href=address) if address else join([text])


def scrolling_table(
    heads: Iterable[Markup], rows: Iterable[Iterable[Markup]]
) -> Markup:
    """A table that scrolls where it is too wide, of heads and rows of cells."""
    lines = [element("tr", *row) for row in rows]
    head = element("thead", element("tr", *heads))
    body = element("tbody", Markup("\n".join(["", *lines])))
    return element("div", element("table", head, body), class_="scroll")


def description_list(entries: Iterable[tuple[str, str]]) -> Markup:
    """A list of heads, each with its description."""
    return element("dl", *(element("dt", a) + element("dd", b) for a, b in entries))


def fold(summary: str, *content: str) -> Markup:
    """Fold a piece of a page away behind its summary; readers may unfold it."""
    return element("details", element("summary", summary), *content)
