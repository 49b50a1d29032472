"""Reading theories: from a text or a file, statement by statement, with its imports.

A mistake spoils its own statement only: reading goes on, and what mentions a name that
a spoilt statement should have declared is passed over, so each mistake is told once.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ttr.errors import NotationError, Span, TTRError
from ttr.interning import identity
from ttr.notation import trees
from ttr.notation.grammar import blocks, statement, vetted
from ttr.notation.reader import Reader
from ttr.notation.statements import Declaring, mentioned
from ttr.notation.trees import Part, Source, Statement
from ttr.theories import Mistakes, Theory

__all__ = ["Unreadable", "theory_of_file", "theory_of_text"]

IMPORTS = 50
"""How long a chain of files may be that import one another."""

MISTAKES = 100
"""After how many mistakes a text is read no further."""


class Unreadable(TTRError):
    """A file that is not there, or is no text."""


def theory_of_text(text: str, source: str = "<text>") -> Theory:
    """The theory that a text declares; an import is relative to the working directory.

    Raises the mistake in it, or `Mistakes` where there are several.
    """
    return _sound(_Files({}).read(Source.of(text, source), Path(), ()))


def theory_of_file(path: Path) -> Theory:
    """The theory in a file; raises `Unreadable`, the mistake in it, or `Mistakes`."""
    return _sound(_Files({}).file(path, ()))


@dataclass(frozen=True)
class _Reading:
    """What has been read: the theory, and the mistakes so far.

    `mentioned` are the names that what was read rests on: a predicate among them has
    its final arities. `spoilt` are the names that should have been declared.
    """

    theory: Theory
    mentioned: frozenset[str] = frozenset()
    spoilt: frozenset[str] = frozenset()
    mistakes: tuple[TTRError, ...] = ()


def _sound(reading: _Reading) -> Theory:
    if not reading.mistakes:
        return reading.theory
    if len(reading.mistakes) == 1:
        raise reading.mistakes[0]
    raise Mistakes.of(reading.mistakes)


@dataclass(frozen=True)
class _Files:
    """The files read so far, each once, however often it is imported."""

    known: dict[Path, _Reading]

    def file(self, path: Path, chain: tuple[Path, ...]) -> _Reading:
        """What a file declares; `chain` are the files whose imports led to it."""
        key, text = _contents(path)
        if key in chain:
            names = " → ".join(step.name for step in (*chain[chain.index(key) :], key))
            raise NotationError(f"the imports go in a circle: {names}")
        if len(chain) >= IMPORTS:
            raise NotationError(f"imports lead on over at most {IMPORTS} files")
        if key not in self.known:
            source = Source(text, str(path))
            self.known[key] = self.read(source, path.parent, (*chain, key))
        return self.known[key]

    def read(self, source: Source, folder: Path, chain: tuple[Path, ...]) -> _Reading:
        """What a text declares; `folder` is where its imports are."""
        reading = _Reading(Theory(source=source.name))
        try:
            vetted(source)
        except NotationError as error:
            return replace(reading, mistakes=(error,))
        places = list(blocks(source.text))
        later: dict[str, int] = {}
        line, at = 1, 0
        for start, _ in places:
            line, at = line + source.text.count("\n", at, start), start
            for name in _announced(source.text, start):
                later.setdefault(name, line)
        file = _File(source, folder, chain, self, later)
        for start, end in places:
            if len(reading.mistakes) >= MISTAKES:
                return file.given_up(reading, start, end)
            reading = file.after(reading, start, end)
        return reading


def _contents(path: Path) -> tuple[Path, str]:
    """A file's one true path and its text; raises `Unreadable`."""
    try:
        return path.resolve(), path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise Unreadable(f"there is no file {path}") from None
    except OSError as error:
        why = (error.strerror or "it cannot be opened").lower()
        raise Unreadable(f"{path} cannot be read: {why}") from None
    except UnicodeDecodeError:
        raise Unreadable(f"{path} is no text: it must be UTF-8") from None
    except (ValueError, RuntimeError):
        raise Unreadable(f"{str(path)!r} is no path of a file") from None


_DECLARES = re.compile(r"(basic|pred|object)\s+(.*)|(\w+)\s*:=")


def _announced(text: str, start: int) -> list[str]:
    """The names that the statement starting there seems to declare."""
    found = _DECLARES.match(text, start)
    if found is None:
        return []
    if found[3]:
        return [found[3]]
    return list(_listed(found[2]))


def _listed(text: str) -> Iterator[str]:
    """The names in a list of them, but for those in brackets or behind a colon."""
    depth = 0
    for sign in re.findall(r"\w+|[\[({\])}:#]", text):
        if sign in (":", "#"):
            return
        depth += (sign in "[({") - (sign in "])}")
        if depth == 0 and sign not in "])}":
            yield sign


@dataclass(frozen=True)
class _File:
    """One text that is being read: where it is, and where its names are declared."""

    source: Source
    folder: Path
    chain: tuple[Path, ...]
    files: _Files
    later: Mapping[str, int]

    def after(self, reading: _Reading, start: int, end: int) -> _Reading:
        """What has been read after the statement text[start:end]."""
        try:
            tree = statement(self.source, start, end)
            names = mentioned(tree)
            if names & reading.spoilt:
                return self._spoilt(reading, start)
            found = self._read(reading, tree)
        except TTRError as error:
            return self._spoilt(reading, start, error)
        except RecursionError:
            span = self.source.span(Part(start, end))
            deep = NotationError("this nests too deep to be read here", span=span)
            return self._spoilt(reading, start, deep)
        return replace(found, mentioned=found.mentioned | names)

    def given_up(self, reading: _Reading, start: int, end: int) -> _Reading:
        """What has been read, and that it goes no further than text[start:end]."""
        span = self.source.span(Part(start, end))
        last = NotationError(f"reading stops after {MISTAKES} mistakes", span=span)
        return replace(reading, mistakes=(*reading.mistakes, last))

    def _spoilt(self, reading: _Reading, start: int, *mistakes: TTRError) -> _Reading:
        names = frozenset(_announced(self.source.text, start)) - reading.theory.names
        return replace(
            reading,
            spoilt=reading.spoilt | names,
            mistakes=reading.mistakes + mistakes,
        )

    def _read(self, reading: _Reading, tree: Statement) -> _Reading:
        if isinstance(tree, trees.Import):
            return self._import(reading, tree)
        reader = Reader(reading.theory, self.source, self.later)
        theory = Declaring(reader, reading.mentioned).declared(tree)
        return replace(reading, theory=theory)

    def _import(self, reading: _Reading, tree: trees.Import) -> _Reading:
        span = self.source.span(tree)
        try:
            found = self.files.file(self.folder / tree.path, self.chain)
        except TTRError as error:
            raise error.at(span) from None
        mine = reading.mistakes
        return _Reading(
            _joined(reading.theory, found.theory, span),
            reading.mentioned | frozenset(found.theory.predicates),
            reading.spoilt | found.spoilt,
            mine + tuple(one for one in found.mistakes if one not in mine),
        )


def _joined(mine: Theory, other: Theory, span: Span) -> Theory:
    """The theory with what another declares, but for its checks.

    Raises `NotationError` where a name means something else in the other.
    """
    for name in sorted(mine.names & other.names):
        if _meaning(mine, name) != _meaning(other, name):
            message = f"{name} is declared in another way in the import"
            raise NotationError(message, span=span)
    return replace(
        mine,
        basics={**mine.basics, **other.basics},
        predicates={**mine.predicates, **other.predicates},
        definitions={**mine.definitions, **other.definitions},
        objects=mine.objects | other.objects,
        opened=mine.opened | other.opened,
        axioms=_union(mine.axioms, other.axioms),
        givens=_union(mine.givens, other.givens),
    )


def _meaning(theory: Theory, name: str) -> object:
    """What a name is declared as, in a form that can be compared."""
    return name if name in theory.objects else (Theory, identity(theory[name]))


def _union(mine: tuple[Any, ...], other: tuple[Any, ...]) -> tuple[Any, ...]:
    """The one and then what is new in the other; a fact imported twice is one fact."""
    return mine + tuple(one for one in other if one not in mine)
