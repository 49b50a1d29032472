"""Whatever stands in an element is a text, unless it is a piece of a page already."""

from __future__ import annotations

from html.parser import HTMLParser

from hypothesis import given
from hypothesis import strategies as st

from kille.lab.reports.elements import Markup, element, fold, join, link

TEXTS = st.text(st.sampled_from("a&<>\"'/= ;#"), max_size=12)


class Reader(HTMLParser):
    """The elements of a page, their attributes, and the text between them."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data


@given(TEXTS, TEXTS)
def test_no_text_becomes_markup(inside: str, address: str) -> None:
    page = Reader(element("p", inside, link(inside, address)))
    assert page.text == inside * 2
    inner = [("a", {"href": address})] if address else []
    assert page.found == [("p", {}), *inner]


@given(TEXTS)
def test_what_is_put_together_stays_escaped(text: str) -> None:
    assert element("b", text) + text == join([element("b", text), text])
    assert Reader(fold(text, element("b", text) + text)).text == text * 3


def test_a_text_made_of_markup_is_a_text_again() -> None:
    assert element("p", f"{element('b', 'x')}") == "<p>&lt;b&gt;x&lt;/b&gt;</p>"
    assert element("p", Markup("<b>x</b>")) == "<p><b>x</b></p>"
