"""Whether every link and picture of a folder of web pages leads somewhere in it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from html import unescape
from pathlib import Path
from urllib.parse import unquote, urlsplit

from tools.playground.links import LINK_START

_TAG = re.compile(r"<[a-zA-Z][^<>]*>")
_LED_TO = re.compile(r"""\s(?:href|src)=(?:"([^"]*)"|'([^']*)')""")
_NAMED = re.compile(r"""\s(?:id|name)=(?:"([^"]*)"|'([^']*)'|([^\s"'<>]+))""")
_CODE = re.compile(r"<(script|style|svg)\b.*?</\1>", flags=re.S)


def lost_links(folder: Path) -> Mapping[str, list[str]]:
    """The links of each page that lead to no file of the folder, or no place in it."""
    found = {
        page.relative_to(folder).as_posix(): list(_broken_links(page, folder.resolve()))
        for page in sorted(folder.rglob("*.html"))
    }
    return {page: lost for page, lost in found.items() if lost}


def _broken_links(page: Path, folder: Path) -> Iterator[str]:
    for link in sorted(_parts(page)[0]):
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        path = unquote(parts.path)
        target = (page.parent / path).resolve() if path else page
        if target.is_dir():
            target = target / "index.html"
        if (
            folder not in [target, *target.parents]
            or not target.is_file()
            or (
                target.suffix == ".html"
                and not parts.fragment.startswith(LINK_START)
                and unquote(parts.fragment) not in _parts(target)[1]
            )
        ):
            yield link


@cache
def _parts(page: Path) -> tuple[frozenset[str], frozenset[str]]:
    """The targets of the links of a page, and the places in it that have a name."""
    text = page.read_text("utf-8")
    tags = " ".join(_TAG.findall(_CODE.sub("", text)))
    links = frozenset(unescape(a or b) for a, b in _LED_TO.findall(tags))
    names = frozenset(unescape(a or b or c) for a, b, c in _NAMED.findall(tags))
    return links - {"", "data:,"}, names | {"", "top"}


def compact(text: str) -> str:
    """The page without what nobody sees: marks that no style is for, and indentation.

    >>> compact("<ul>\\n    <li>one</li></ul><pre>  as it is</pre>")
    '<ul>\\n<li>one</li></ul><pre>  as it is</pre>'
    >>> compact('<code class="docutils literal"><span class="pre">S</span></code>')
    '<code class="literal">S</code>'
    """
    text = _COMMENT.sub("", text)
    text = _UNUSED_ICON.sub(r"#svg-\1", text)
    for unstyled in _UNSTYLED:
        text = unstyled.sub(r"\1", text)
    text = text.replace('class="docutils literal', 'class="literal')
    text = text.replace('class="reference internal"', 'class="reference"')
    parts = re.split(r"(<pre\b.*?</pre>)", text, flags=re.S)
    return "".join(
        it if i % 2 else re.sub(r"\s*\n\s*", "\n", it) for i, it in enumerate(parts)
    )


_COMMENT = re.compile(r"<!--.*?-->", flags=re.S)
_UNUSED_ICON = re.compile(r"#svg-(sun|moon)-with-(?:moon|sun)")
_UNSTYLED = (
    re.compile(r'<span class="(?:pre|w)">([^<]*)</span>'),
    re.compile(r'<span class="std std-\w+">((?:[^<]|<code[^>]*>[^<]*</code>)*)</span>'),
)
