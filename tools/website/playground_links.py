"""Links of blocks of code to the playground, where their theories run."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from docutils import nodes
from sphinx.application import Sphinx

from tools.playground.links import LinkError, link_fragment
from tools.playground.texts import opens_alone, theories_in_python

HAS_PLAYGROUND = "kille_has_playground"
"""The setting of Sphinx that says whether the site has a playground."""

_PYTHON = ("python", "pycon", "ipython3", "ipython")


def add_playground_links(app: Sphinx, doctree: nodes.document, page: str) -> None:
    """Add to each block that has a theory a link below it which opens the theory.

    The reference of Python is left as it is: its theories are a line or two.
    """
    if not app.config[HAS_PLAYGROUND] or page.startswith("api/"):
        return
    for block in list(doctree.findall(nodes.literal_block)):
        text, language = block.astext(), block.get("language", "")
        every = [
            playground_link(it, page.count("/")) for it in _theories(text, language)
        ]
        links = [f'<p class="in-playground">{it}</p>' for it in every if it]
        if links:
            whole = _with_frame(block)
            raw = nodes.raw("", "".join(links), format="html")
            whole.parent.insert(whole.parent.index(whole) + 1, raw)


def _with_frame(block: nodes.literal_block) -> nodes.Element:
    """A block, or the frame of a notebook's cell that it stands in."""
    framed = "cell_input" in block.parent.get("classes", ())
    return block.parent if framed else block


def playground_link(text: str, depth: int) -> str:
    """A link from a page so many folders deep; empty for a theory too long for one."""
    try:
        fragment = link_fragment(text)
    except LinkError:
        return ""
    href = f"{'../' * depth}playground/index.html#{fragment}"
    return f'<a href="{escape(href)}">Open in the playground</a>'


def _theories(text: str, language: str) -> Iterator[str]:
    if language == "ttr" and opens_alone(text):
        yield text
    elif language in _PYTHON:
        yield from theories_in_python(text)
