"""Docstrings as MyST: prose with backticks, lists, doctests and what is indented."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

Link = Callable[[str], str | None]
"""Where a name in backticks leads, or nothing."""

_CODE = re.compile(r"(``.+?``|`[^`]+`)", flags=re.S)
_EMPHASIS = re.compile(r"(\*\w[^*]*\w\*|\*\w\*)")
_ACTIVE = re.compile(r"([\\*_\[\]<>#|~$&{}!^@])")
_ITEM = re.compile(r"(?:[-*]|\d+\.) ")
_DIRECTIVE = re.compile(r" *# doctest: *[+-].*$", flags=re.M)


def docstring_as_myst(text: str, link: Link = lambda _: None) -> str:
    """The docstring as MyST, with names in backticks linked where they lead somewhere.

    >>> docstring_as_myst("The meet of `S`.\\n\\n>>> 1 + 1\\n2").splitlines()
    ['The meet of `S`.', '', '```pycon', '>>> 1 + 1', '2', '```']
    """
    return "\n\n".join(_block(it, link) for it in _paragraphs(text))


def prose_as_myst(text: str, link: Link = lambda _: None) -> str:
    """Prose as MyST: what Markdown would take for markup is escaped, but for backticks.

    >>> print(prose_as_myst("p_o is *the* share of [x : Ind]"))
    p\\_o is *the* share of \\[x : Ind\\]
    """
    parts = _CODE.split(text)
    return "".join(
        _code(it, link) if i % 2 else _escape_text(it) for i, it in enumerate(parts)
    )


def sentences(text: str) -> list[str]:
    """The sentences of the prose of a docstring.

    >>> sentences("It is one. Raises `X` for i.e. none.\\n\\n>>> 1. \\n1")
    ['It is one.', 'Raises `X` for i.e. none.']
    """
    prose = [it for it in _paragraphs(text) if not _is_code(it)]
    flat = [" ".join(it.split()) for it in prose]
    return [it for one in flat for it in re.split(r"(?<=[.:?;])\s+(?=[A-Z`])", one)]


def has_example(text: str) -> bool:
    """Whether a docstring has a doctest."""
    return ">>> " in text


def _paragraphs(text: str) -> Iterator[str]:
    """The paragraphs, the lines of each as they are."""
    for paragraph in re.split(r"\n[ \t]*\n", text.strip("\n")):
        lines = paragraph.splitlines()
        start = next((i for i, it in enumerate(lines) if it.startswith(">>> ")), None)
        if start:  # prose that a doctest follows without a line between
            yield "\n".join(lines[:start])
            lines = lines[start:]
        if lines:
            yield "\n".join(lines)


def _is_code(paragraph: str) -> bool:
    return paragraph.startswith((">>> ", "    "))


def _block(paragraph: str, link: Link) -> str:
    if paragraph.startswith(">>> "):
        return f"```pycon\n{_DIRECTIVE.sub('', paragraph)}\n```"
    if paragraph.startswith("    "):
        return f"```text\n{_dedent(paragraph)}\n```"
    if _ITEM.match(paragraph):
        return "\n".join(_item(it, link) for it in _items(paragraph))
    return _line_start(prose_as_myst(paragraph, link))


def _items(paragraph: str) -> list[str]:
    return re.split(r"\n(?=(?:[-*]|\d+\.) )", paragraph)


def _item(text: str, link: Link) -> str:
    mark, _, said = text.partition(" ")
    return f"{mark} {prose_as_myst(' '.join(said.split()), link)}"


def _dedent(paragraph: str) -> str:
    lines = paragraph.splitlines()
    least = min(len(it) - len(it.lstrip()) for it in lines if it.strip())
    return "\n".join(it[least:] for it in lines)


def _line_start(text: str) -> str:
    """Text in which no line starts a list, a heading or a field."""
    text = re.sub(r"^([ \t]*)([-+=:])", r"\1\\\2", text, flags=re.M)
    return re.sub(r"^([ \t]*\d+)([.)] )", r"\1\\\2", text, flags=re.M)


def _code(span: str, link: Link) -> str:
    target = link(span.strip("`"))
    return f"[{span}]({target})" if target else span


def _escape_text(text: str) -> str:
    parts = _EMPHASIS.split(text)
    return "".join(
        it if i % 2 else _ACTIVE.sub(r"\\\1", it) for i, it in enumerate(parts)
    )
