"""What theories declare, where, and what it means: to hover, to jump, to complete."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

from ttr.computing.normalisation import normal_form
from ttr.dialogues.settings import theory_in
from ttr.editing.tokens import Kind, Token, theory_tokens
from ttr.errors import Span, TTRError
from ttr.notation.scanning import find_statements
from ttr.notation.syntax_trees import Part, Source
from ttr.safety.budgets import budget
from ttr.safety.consent import OWN_FOLDER, Consent
from ttr.safety.inputs import read_text
from ttr.safety.limits import STORIES, THEORY
from ttr.theories.loading import UnreadableError, read_draft
from ttr.theories.theory import Theory, theory_of_draft
from ttr.types.printing import notation
from ttr.types.syntax import Application, Function, RecordType, TypeNode

_STEPS = 20_000
"""How many steps the normal form of one name may take; most take a few hundred."""

_SHOWN = 2_000
"""How many characters of a statement or a type are shown."""


@dataclass(frozen=True)
class Declaration:
    """A name that a text declares, with its place and that of the statement.

    `comment` is what the lines of comment right above the statement say.
    """

    name: str
    kind: Kind
    span: Span
    start: int
    end: int
    statement: str
    comment: str = ""


def declarations(text: str, file: str = "<text>") -> tuple[Declaration, ...]:
    """The names that a text declares, also where it does not parse.

    >>> for one in declarations("# Animals.\\npred dog(Ind), cat(Ind)"):
    ...     print(one.name, one.kind, one.span.column, one.comment)
    dog predicate 6 Animals.
    cat predicate 16 Animals.
    """
    source = Source(text, file)
    return tuple(_declarations(source, theory_tokens(text)))


def _declarations(source: Source, tokens: tuple[Token, ...]) -> Iterator[Declaration]:
    text = source.text
    declaring = [token for token in tokens if token.declares][::-1]
    before = 0
    for start, end in find_statements(text):
        *above, indent = text[before:start].split("\n")
        own_lines = above[1:] if before else above  # the first is another's end
        comment = "" if indent.strip() else comment_above(reversed(own_lines))
        before = end
        while declaring and declaring[-1].start < end:
            token = declaring.pop()
            place = source.span(Part(token.start, token.end))
            yield Declaration(
                *(token.of(text), token.kind, place, start, end),
                text[start:end],
                comment,
            )


def comment_above(lines: Iterable[str]) -> str:
    """What the lines of comment right above a statement say.

    The lines are given from the bottom up, and none is asked for above the comment.

    >>> comment_above(["  # Animals.", "# ---", "basic Ind", "# Not this."])
    'Animals.'
    """
    comment = takewhile(lambda line: line.startswith("#"), map(str.strip, lines))
    said = [line.lstrip("#").strip() for line in comment]
    return "\n".join(line for line in reversed(said) if line.strip("-= "))


@dataclass(frozen=True)
class Meaning:
    """What is shown of a name: notation, and what to say of it.

    `places` are where it is declared; a predicate may be declared several times.
    """

    name: str
    kind: Kind
    statements: tuple[str, ...]
    about: tuple[str, ...] = ()
    comment: str = ""
    places: tuple[Span, ...] = ()


def names_in_scope(
    path: Path,
    consent: Consent = OWN_FOLDER,
    text_of: Callable[[Path], str | None] = lambda path: None,
) -> tuple[Meaning, ...]:
    """What the names mean that a theory, or a file of stories, may use.

    What stands in spite of mistakes is among them. `text_of` may give the text of a
    file that has not been saved. Never raises an error for what stands in a file.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "a.ttr")
    ...     _ = file.write_text("basic A\\nf := \\\\x:A. x\\nobject a : A\\nb := f(a)")
    ...     for one in names_in_scope(file):
    ...         print(*one.statements, "|", *one.about)
    basic A |
    f := \\x:A. x | a function from A
    object a : A | a : A
    b := f(a) | computes to `a`
    """
    texts: dict[Path, str] = {}

    def read(one: Path) -> str:
        found = text_of(one)
        if found is None:
            found = read_text(one, THEORY)
        THEORY.check(len(found))
        texts[one] = found.replace("\r\n", "\n").replace("\r", "\n")
        return texts[one]

    try:
        theory_path = _theory_of_stories(path, text_of) if _is_story(path) else path
        if theory_path is None:
            return ()
        allowed = consent.with_folders(path.parent)
        theory = theory_of_draft(read_draft(theory_path, allowed, read).draft)
    except (UnreadableError, OSError, UnicodeDecodeError):
        return ()
    declared: dict[str, list[Declaration]] = {}
    for file, text in texts.items():
        for one in declarations(text, str(file)):
            declared.setdefault(one.name, []).append(one)
    return tuple(_meaning(found, theory) for found in declared.values())


def _is_story(path: Path) -> bool:
    return path.suffix == ".dlg"


def _theory_of_stories(
    path: Path, text_of: Callable[[Path], str | None]
) -> Path | None:
    """The theory whose game the stories in a file name first; None if none does."""
    text = text_of(path)
    found = re.search(
        r"^\s*@\s*game[ \t]+(\S.*)$",
        read_text(path, STORIES) if text is None else text,
        re.MULTILINE,
    )
    named = theory_in(found[1].strip()) if found else ""
    return path.parent / named if named else None


def _meaning(found: list[Declaration], theory: Theory) -> Meaning:
    first = found[0]
    statements = dict.fromkeys(_shorten(one.statement) for one in found)
    return Meaning(
        first.name,
        first.kind,
        tuple(statements),
        tuple(_about(first.name, theory)),
        first.comment,
        tuple(one.span for one in found),
    )


def _about(name: str, theory: Theory) -> Iterator[str]:
    """What can be said of a name besides the statement that declares it."""
    if name in theory.objects:
        for given in theory.givens:
            if getattr(given, "sit", None) == name:
                yield f"{name} : {_shorten(notation(given.type))}"
        return
    if name not in theory.definitions:
        return
    value = theory.definitions[name]
    scope = theory.spelling_of(name)
    match value:
        case Function():
            yield f"a function from {_shorten(notation(value.domain, scope))}"
        case Application():
            pass
        case RecordType():
            yield "a record type"
        case TypeNode():
            yield "a type"
    try:
        with budget(steps=_STEPS):
            normal = normal_form(value, theory)
    except TTRError:
        return
    if normal is not value and notation(normal, scope) != notation(value, scope):
        yield f"computes to `{_shorten(notation(normal, scope))}`"


def _shorten(text: str) -> str:
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"
