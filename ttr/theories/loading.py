"""Reading theories: from a text or a file, statement by statement, with its imports.

Reading goes on after a mistake. Statements that mention a name which the spoilt one
should have declared are passed over, so that each mistake is reported once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from ttr.errors import MistakesError, NotationError, Span, TooLargeError, TTRError
from ttr.notation import syntax_trees as trees
from ttr.notation.names import Names, is_declared, meaning_of
from ttr.notation.parser import parse_statement
from ttr.notation.reader import read_term as read_term_of_text
from ttr.notation.scanning import check_characters, find_statements
from ttr.notation.syntax_trees import Part, Source
from ttr.safety.budgets import SharedPurse, one_of_several, purse_of_several
from ttr.safety.consent import OWN_FOLDER, Consent, NotAllowedError, check_called
from ttr.safety.files import why_unread
from ttr.safety.inputs import read_text
from ttr.safety.limits import THEORY
from ttr.theories import theory
from ttr.theories.statements import StatementReader, names_mentioned
from ttr.theories.theory_draft import Draft
from ttr.types.interning import identity

_IMPORTS = 50
"""The longest chain of files that import one another."""

_MISTAKES = 100
"""After this many mistakes, the rest of a text is not read."""


class UnreadableError(TTRError):
    """The file does not exist, or is no text."""


ReadText = Callable[[Path], str]
"""Reads the text of a theory file; raises `OSError` or `UnicodeDecodeError`."""


def read_theory_text(path: Path) -> str:
    """The text of a theory file; raises `OSError` or `UnicodeDecodeError`."""
    return read_text(path, THEORY)


theory.read_term.provided_by(read_term_of_text)


@theory.draft_of_text.provided_by
def _draft_of_text(text: str, source: str, consent: Consent | None) -> Draft:
    """What a text declares of a theory; an import is relative to the working directory.

    It may import from the working directory, or from where `consent` allows. Raises the
    mistake in it, or `MistakesError` if there are several.
    """
    allowed = Consent.of([""]) if consent is None else consent
    return _draft_if_sound(
        _Files(allowed, {}).read_source(Source.of(text, source), Path(), ())
    )


@theory.draft_of_file.provided_by
def _draft_of_file(path: Path, consent: Consent, read: ReadText | None) -> Draft:
    """What a file declares of a theory.

    It, and what it imports, may import from its folder, or from where the user's
    consent allows. `read` reads the text of each file, if they are not read from disk.
    Raises `UnreadableError`, the mistake in it, or `MistakesError`.
    """
    return _draft_if_sound(read_draft(path, consent, read or read_theory_text))


def read_draft(
    path: Path, consent: Consent = OWN_FOLDER, read: ReadText = read_theory_text
) -> Reading:
    """What can be read of a file in spite of the mistakes in it, and these mistakes.

    Raises `UnreadableError`.
    """
    allowed = consent.with_folders(path.parent)
    return _Files(allowed, {}, read).read_file(path, ())


@dataclass(frozen=True)
class Reading:
    """What has been read of a theory, and the mistakes in it.

    `spoilt` are the names that statements with mistakes should have declared.
    """

    draft: Draft
    spoilt: frozenset[str] = frozenset()
    mistakes: tuple[TTRError, ...] = ()


def _draft_if_sound(reading: Reading) -> Draft:
    if not reading.mistakes:
        return reading.draft
    if len(reading.mistakes) == 1:
        raise reading.mistakes[0]
    raise MistakesError.of(reading.mistakes)


@dataclass(frozen=True)
class _Files:
    """Reads files, each of them once, however often it is imported."""

    consent: Consent
    known: dict[Path, Reading]
    read: ReadText = read_theory_text
    purse: SharedPurse = field(default_factory=purse_of_several)

    def read_import(self, path: Path, named: str, chain: tuple[Path, ...]) -> Reading:
        """What a file declares that another one imports as `named`.

        Only theory files are read, and only where consent allows: otherwise an import
        could be used to show lines of any file in an error message.
        """
        check_called(path, ".ttr", named)
        self.consent.check(path, named)
        return self.read_file(path, chain)

    def read_file(self, path: Path, chain: tuple[Path, ...]) -> Reading:
        """What a file declares; `chain` lists the files whose imports led to it."""
        key, text = self._path_and_text(path)
        if key in chain:
            names = " → ".join(step.name for step in (*chain[chain.index(key) :], key))
            raise NotationError(f"the imports go in a circle: {names}")
        if len(chain) >= _IMPORTS:
            raise NotationError(f"a chain of imports has at most {_IMPORTS} files")
        if key not in self.known:
            source = Source(text, str(path))
            self.known[key] = self.read_source(source, path.parent, (*chain, key))
        return self.known[key]

    def read_source(
        self, source: Source, folder: Path, chain: tuple[Path, ...]
    ) -> Reading:
        """What a text declares; its imports are relative to `folder`."""
        try:
            check_characters(source)
        except NotationError as error:
            return Reading(Draft(source.name), mistakes=(error,))
        places = list(find_statements(source.text))
        self.purse.allow(len(places))
        later: dict[str, int] = {}
        for start, _ in places:
            for name in _names_declared(source.text, start):
                later.setdefault(name, source.line(start))
        draft = Draft(source.name)
        file = _File(StatementReader(draft, source, later), folder, chain, self)
        for start, end in places:
            if len(file.mistakes) >= _MISTAKES:
                file.give_up(start, end)
                break
            file.read_statement(start, end)
            if file.is_refused:
                break
        return Reading(draft, frozenset(file.spoilt), tuple(file.mistakes))

    def _path_and_text(self, path: Path) -> tuple[Path, str]:
        """A file's path without links, and its text; raises `UnreadableError`."""
        try:
            return path.resolve(), self.read(path)
        except (OSError, UnicodeDecodeError) as error:
            raise UnreadableError(why_unread(path, error)) from None
        except (ValueError, RuntimeError):
            raise UnreadableError(f"{str(path)!r} is no path of a file") from None


_DECLARES = re.compile(
    r"(basic|pred|object)\s+(.*)|(?:rule|strategy|game)\s+(\w+)|(\w+)\s*:="
)


def _names_declared(text: str, start: int) -> list[str]:
    """The names that the statement at `start` declares, as far as can be seen."""
    found = _DECLARES.match(text, start)
    if found is None:
        return []
    if found[3] or found[4]:
        return [found[3] or found[4]]
    return list(_names_in_list(found[2]))


def _names_in_list(text: str) -> Iterator[str]:
    """The names in a list, without those in brackets or after a colon."""
    depth = 0
    for sign in re.findall(r"\w+|[\[({\])}:#]", text):
        if sign in (":", "#"):
            return
        depth += (sign in "[({") - (sign in "])}")
        if depth == 0 and sign not in "])}":
            yield sign


@dataclass(eq=False)
class _File:
    """One text that is being read, and the mistakes found so far.

    `spoilt` are the names that statements with mistakes should have declared.
    """

    declaring: StatementReader
    folder: Path
    chain: tuple[Path, ...]
    files: _Files
    spoilt: set[str] = field(default_factory=set)
    mistakes: list[TTRError] = field(default_factory=list)

    @property
    def source(self) -> Source:
        """The text."""
        return self.declaring.source

    @property
    def is_refused(self) -> bool:
        """Was an import not allowed? Without it nothing more can be said."""
        return any(isinstance(one, NotAllowedError) for one in self.mistakes)

    def read_statement(self, start: int, end: int) -> None:
        """Reads the statement text[start:end]."""
        try:
            tree = parse_statement(self.source, start, end)
            if self.spoilt and not names_mentioned(tree).isdisjoint(self.spoilt):
                self._spoil(start)
            elif isinstance(tree, trees.Import):
                self._import(tree)
            else:
                with one_of_several(self.files.purse):
                    self.declaring.declare(tree)
        except TooLargeError as error:
            span = self.source.span(Part(start, end))
            self.mistakes.append(error.at(span))
            self._spoil(start)
        except TTRError as error:
            self.mistakes.append(error)
            self._spoil(start)
        except RecursionError:
            span = self.source.span(Part(start, end))
            deep = NotationError("this nests too deep to be read here", span=span)
            self.mistakes.append(deep)
            self._spoil(start)

    def give_up(self, start: int, end: int) -> None:
        """Report that reading stops at the statement text[start:end]."""
        span = self.source.span(Part(start, end))
        last = NotationError(f"reading stops after {_MISTAKES} mistakes", span=span)
        self.mistakes.append(last)

    def _spoil(self, start: int) -> None:
        """Remember that what the statement at `start` should declare is missing."""
        names = _names_declared(self.source.text, start)
        draft = self.declaring.draft
        self.spoilt.update(name for name in names if not is_declared(draft, name))

    def _import(self, tree: trees.Import) -> None:
        span = self.source.span(tree)
        try:
            path = self.folder / tree.path
            found = self.files.read_import(path, tree.path, self.chain)
        except TTRError as error:
            raise error.at(span) from None
        _merge_import(self.declaring.draft, found.draft, span)
        self.spoilt |= found.spoilt
        self.mistakes += [one for one in found.mistakes if one not in self.mistakes]


def _merge_import(mine: Draft, other: Draft, span: Span) -> None:
    """Add what another theory declares, without its checks.

    Raises `NotationError` if a name means something else there.
    """
    for name in sorted(mine.names & other.names):
        if _comparable_meaning(mine, name) != _comparable_meaning(other, name):
            message = f"the import declares {name} in another way"
            raise NotationError(message, span=span)
    mine.basics.update(other.basics)
    mine.predicates.update(other.predicates)
    mine.definitions.update(other.definitions)
    mine.rules.update(other.rules)
    mine.strategies.update(other.strategies)
    mine.openings.update(other.openings)
    mine.objects |= other.objects
    mine.declared.update(other.declared)
    mine.written.update(other.written)
    mine.defined_at.update(other.defined_at)
    mine.opened |= other.opened
    mine.axioms.update(other.axioms)
    mine.exclusions.update(other.exclusions)
    known = set(mine.givens)  # a fact imported twice is one fact
    mine.givens += [given for given in other.givens if given not in known]
    mine.used.update(other.predicates)


def _comparable_meaning(theory: Names, name: str) -> object:
    """What a name is declared as, as a value that can be compared."""
    for kind in (theory.rules, theory.strategies, theory.openings):
        if name in kind:
            return kind[name]
    return name if name in theory.objects else ("", identity(meaning_of(theory, name)))
