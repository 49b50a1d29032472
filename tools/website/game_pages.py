"""A page for each game of tutoring: its dialogue, its rules and where they stand."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping
from importlib import import_module
from types import ModuleType

from tools.website.docstrings import docstring_as_myst, prose_as_myst
from tools.website.public_names import definition
from tools.website.repository_pages import DOCS
from ttr.errors import UnsupportedError
from ttr.updates import Rule
from ttr.updates.rule_notation import format_rule

FOLDER = "games"
_PLAYED = DOCS / "reference" / "games.md"


def game_pages() -> Mapping[str, str]:
    """The pages of the games, with an index of them."""
    sections = dict(_sections())
    pages = {f"{FOLDER}/{name}": _page(name, *it) for name, it in sections.items()}
    return {**pages, f"{FOLDER}/index": _index(sections)}


def _sections() -> Iterator[tuple[str, tuple[str, str]]]:
    """The games that are shown as they are played: module, then title and table."""
    text = _PLAYED.read_text("utf-8")
    for section in re.split(r"^## ", text, flags=re.M)[1:]:
        title, _, rest = section.partition("\n")
        found = re.search(r"`kille/dialogue/games/(\w+)\.py`", rest)
        assert found is not None
        yield found[1], (title, rest[found.end() :].strip())


def _page(name: str, title: str, table: str) -> str:
    module = import_module(f"kille.dialogue.games.{name}")
    href = f"../source/kille/dialogue/games/{name}.py.html"
    doc = docstring_as_myst(inspect.getdoc(module) or "")
    return "\n\n".join(
        [
            "---\norphan: true\n---",
            f"# {prose_as_myst(title)}",
            f'[All games](index.md) · <a href="{href}">{name}.py</a>',
            doc,
            "## A dialogue",
            *_turns(table),
            "## Its rules",
            *_rules(module),
        ]
    )


def _turns(table: str) -> Iterator[str]:
    """The turns of a dialogue: what is said, then the rules and changes, folded."""
    for row in table.splitlines()[2:]:
        said, rules, changes = (it.strip() for it in _cells(row))
        lines = said.replace("<br>", "\n")
        parts = [f"```text\n{lines}\n```"]
        inner = [f"- {it}" for it in rules.split("<br>") if it]
        inner += [f"- {it}" for it in changes.split("<br>") if it]
        if inner:
            listed = "\n".join(inner)
            summary = "<summary>What fires, and what changes</summary>"
            parts.append(f"<details>{summary}\n\n{listed}\n\n</details>")
        yield "\n\n".join(parts)


def _cells(row: str) -> list[str]:
    cells = re.split(r"(?<!\\)\|", row.strip().strip("|"))
    return [*cells, "", ""][:3]


def _rules(module: ModuleType) -> Iterator[str]:
    """The rules that a module defines, in the order of its text."""
    rules = {
        name: it
        for name, it in vars(module).items()
        if isinstance(it, Rule) and definition(module.__name__, name).node is not None
    }
    own = {
        name: it
        for name, it in rules.items()
        if definition(module.__name__, name).module == module.__name__
    }
    for name, rule in own.items():
        source = definition(module.__name__, name)
        href = f"../source/{source.file.as_posix()}.html#L{source.line}"
        notation = _notation(rule)
        shown = [f"```ttr\n{notation}\n```"] if notation else []
        yield "\n\n".join(
            [
                f"### `{rule.name}`",
                f'<a class="source-link" href="{href}">source</a>',
                docstring_as_myst(rule.doc or ""),
                *shown,
            ]
        )
    if not own:
        yield "It is put together from the rules of other games."


def _notation(rule: Rule) -> str:
    try:
        return format_rule(rule)
    except UnsupportedError:
        return ""


def _index(sections: Mapping[str, tuple[str, str]]) -> str:
    lines = [
        "# The games of tutoring, one by one\n",
        "What a tutor and the robot can do with words is a game, and a game is a page",
        "of rules of update. [One page](/reference/games.md) has them all.\n",
        "| game | what it is |",
        "| --- | --- |",
    ]
    for name, (title, _) in sections.items():
        module = import_module(f"kille.dialogue.games.{name}")
        doc = (inspect.getdoc(module) or "").split("\n\n")[0]
        said = prose_as_myst(" ".join(doc.split())).replace("|", "\\|")
        lines.append(f"| [{prose_as_myst(title)}]({name}.md) | {said} |")
    return "\n".join(lines) + "\n"
