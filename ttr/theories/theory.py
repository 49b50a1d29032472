"""A theory: what is declared, defined, assumed and claimed, as one immutable value."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sized
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Protocol, overload

from ttr.errors import IllFormedError, Span, TTRError, suggestion
from ttr.hooks import hook
from ttr.notation.names import all_names, vocabulary_of
from ttr.safety.consent import OWN_FOLDER, Consent
from ttr.showing import (
    Fields,
    Fold,
    In,
    NotebookValue,
    Part,
    Text,
    Value,
    below,
    beside,
    name_list,
    table,
)
from ttr.signature.signature import (
    Expected,
    Given,
    Opening,
    Signature,
)
from ttr.theories.game_opening import open_games
from ttr.theories.theory_draft import Draft
from ttr.types.interning import Node
from ttr.types.objects import Object
from ttr.types.printing import Scope, Written, spelling_of
from ttr.types.syntax import Basic, Pred, kind_of
from ttr.updates.rules import rules_shown

if TYPE_CHECKING:
    from ttr.theories.loading import ReadText
    from ttr.theories.queries import Check
    from ttr.updates.games import Game
    from ttr.updates.rules import Rule
    from ttr.updates.update_strategies import Algorithm


# A theory that was read before is used without what reads theories, which is loaded
# when something is read.


@hook
def read_term(text: str, theory: Theory) -> Object:
    """The type or object that a text stands for; provided by `loading`."""
    raise NotImplementedError


@hook
def draft_of_text(text: str, source: str, consent: Consent | None) -> Draft:
    """What a text declares of a theory; provided by `loading`."""
    raise NotImplementedError


@hook
def draft_of_file(path: FilePath, consent: Consent, read: ReadText | None) -> Draft:
    """What a file declares of a theory; provided by `loading`."""
    raise NotImplementedError


class _ReadTheory(Protocol):
    def __call__(self, text: str, source: str = "<text>") -> Theory: ...


class _Parse:
    """Parse a theory on the class, a type or an object on a theory.

    `Theory.parse(text)` and `theory.parse(term)` both have to be called `parse`; with a
    descriptor, one name can be a class method and a method.
    """

    @overload
    def __get__(self, theory: None, owner: type[Theory]) -> _ReadTheory: ...

    @overload
    def __get__(
        self, theory: Theory, owner: type[Theory]
    ) -> Callable[[str], Object]: ...

    def __get__(
        self, theory: Theory | None, owner: type[Theory]
    ) -> _ReadTheory | Callable[[str], Object]:
        if theory is None:
            return _parse_theory
        return lambda text: read_term(text, theory)


def _parse_theory(text: str, source: str = "<text>") -> Theory:
    """The theory that a text declares; raises `NotationError`, `IllFormedError`,
    `MistakesError`.

    An `import` in it is relative to the working directory, and may not lead out of it.
    """
    return theory_of_text(text, source)


@dataclass(frozen=True, eq=False)
class Theory(NotebookValue, Signature):
    """A signature, with the names declared in it, its rules and the checks it states.

    Its definitions, basic types and predicates are its items, and its attributes unless
    an attribute below has the same name.

    >>> kennel = Theory.parse('''
    ...     basic Ind
    ...     pred  dog(Ind), puppy(Ind)
    ...     Dog := [x : Ind, c : dog(x)]
    ...     puppy(x) <: dog(x)
    ... ''')
    >>> print(kennel.Dog)
    [x : Ind, c : dog(x)]
    >>> kennel.parse("[x : Ind, c : dog(x)]") is kennel["Dog"]
    True
    >>> kennel.Dgo
    Traceback (most recent call last):
    AttributeError: the theory has no Dgo: did you mean Dog?
    """

    basics: Mapping[str, Basic] = field(default_factory=dict)
    predicates: Mapping[str, Pred] = field(default_factory=dict)
    objects: frozenset[str] = frozenset()
    checks: tuple[Check, ...] = ()
    source: str = "<text>"
    rules: Mapping[str, Rule] = field(default_factory=dict)
    strategies: Mapping[str, Algorithm] = field(default_factory=dict)
    openings: Mapping[str, Opening] = field(default_factory=dict)
    written: Mapping[str, Mapping[Node, Written]] = field(default_factory=dict)
    """How each definition is written: the order of fields, the names of variables."""

    defined_at: Mapping[str, Span] = field(default_factory=dict)
    """Where the value of each definition is written."""

    parse = _Parse()

    @classmethod
    def of(cls, *values: object) -> Theory:
        """The smallest theory that declares everything that occurs in the values.

        Law: Theory.of(T).parse(str(T)) is T. Raises `IllFormedError` where two
        predicates of one name occur: no text could tell them apart.

        >>> from ttr import Ind
        >>> sorted(Theory.of(Pred("dog", Ind)("fido")).names)
        ['Ind', 'dog', 'fido']
        """
        said = vocabulary_of(*values)
        return cls(
            basics=said.basics,
            predicates=said.predicates,
            objects=frozenset(said.objects),
        )

    @cached_property
    def signature(self) -> Signature:
        """The theory without its names, rules and checks.

        It is one for all models of the theory, with what was found out about it.
        """
        return Signature(
            self.axioms,
            self.opened,
            self.givens,
            self.definitions,
            self.exclusions,
            self.declared,
            self.spelling,
        )

    def spelling_of(self, name: str) -> Scope:
        r"""How the text writes what a name stands for, as the scope to print it in.

        >>> from ttr.types.printing import notation
        >>> kennel = Theory.parse('basic B, A\nPair := [b : B, a : A]')
        >>> print(kennel.Pair, notation(kennel.Pair, kennel.spelling_of("Pair")))
        [a : A, b : B] [b : B, a : A]
        """
        return spelling_of([self.written.get(name, {}), *self.written.values()])

    @cached_property
    def games(self) -> Mapping[str, Game]:
        """The games, in the model of the theory's givens.

        Raises `TTRError` if the givens contradict one another, or the start of a game
        is not of its type.
        """
        return open_games(self)

    @property
    def names(self) -> frozenset[str]:
        """Every name declared in the theory, also of objects and rules."""
        return all_names(self)

    def __getitem__(self, name: str) -> Object:
        if not isinstance(name, str):
            raise IllFormedError(f"a theory is asked for a name, found {kind_of(name)}")
        for declared in (self.definitions, self.basics, self.predicates):
            if name in declared:
                return declared[name]
        raise KeyError(self._explain_missing(name))

    def __contains__(self, name: object) -> bool:
        """Is this the name of a definition, a basic type or a predicate?"""
        known = (self.definitions, self.basics, self.predicates)
        return any(name in declared for declared in known)

    def __getattr__(self, name: str) -> Object:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise AttributeError(self._explain_missing(name)) from None

    def _explain_missing(self, name: str) -> str:
        played = {
            "rules": self.rules,
            "strategies": self.strategies,
            "games": self.openings,
        }
        for kind, names in played.items():
            if name in names:
                return f"{name} is one of the {kind}: theory.{kind}[{name!r}]"
        terms = [*self.definitions, *self.basics, *self.predicates]
        hint = suggestion(name, [*terms, *(one for k in played.values() for one in k)])
        return f"the theory has no {name}" + f": {hint}" * bool(hint)

    def __dir__(self) -> list[str]:
        terms = [*self.definitions, *self.basics, *self.predicates]
        return sorted({*super().__dir__(), *filter(str.isidentifier, terms)})

    def _ipython_key_completions_(self) -> list[str]:
        return [*self.definitions, *self.basics, *self.predicates]

    def _shown_as_(self) -> Part:
        sections = [
            _section("basic types", self.basics, name_list(self.basics)),
            _section("predicates", self.predicates, _predicates_shown(self)),
            _section("objects", self.objects, name_list(self.objects)),
            _section("definitions", self.definitions, _definitions_shown(self)),
            _section("axioms", self.axioms, _lines_shown(self.axioms)),
            _section("exclusions", self.exclusions, _lines_shown(self.exclusions)),
            _section("given", self.givens, _givens_shown(self)),
            _section("rules", self.rules, rules_shown([*self.rules.values()])),
            _section("strategies", self.strategies, _strategies_shown(self)),
            _section("games", self.openings, _games_shown(self)),
            _section(
                "checks", self.checks, _lines_shown([c.text for c in self.checks])
            ),
        ]
        heading = beside(Text("theory", "strong"), Text(self.source, "quiet"))
        return In(self, below(heading, *sections))

    def __repr__(self) -> str:
        return f"<Theory {self.source}: {', '.join(sorted(self.names))}>"


# --- showing --------------------------------------------------------------------------

_OPEN = 12
"""A section of at most so many is shown open."""


def _section(kind: str, found: Sized, part: Part) -> Part | None:
    if not len(found):
        return None
    return Fold(f"{kind} ({len(found):,})", part, opened=len(found) <= _OPEN)


def _predicates_shown(theory: Theory) -> Part:
    shown = (_with_arities(one) for one in theory.predicates.values())
    return name_list(shown)


def _with_arities(one: Pred) -> str:
    ways = [f"{one.name}({', '.join(map(str, arity))})" for arity in one.arities]
    return " or ".join(ways) or one.name


def _definitions_shown(theory: Theory) -> Part:
    return table(
        ("name", "stands for"),
        theory.definitions.items(),
        lambda it: (Text(it[0], "code"), Value(it[1], unfold=1)),
    )


def _lines_shown(lines: Collection[object]) -> Part:
    return table(("",), lines, lambda line: (Text(str(line), "code"),))


def _givens_shown(theory: Theory) -> Part:
    def row(one: Given | Expected) -> tuple[Part, ...]:
        low, high = one.p
        p = Text(f"{low:g}" if low == high else f"[{low:g}, {high:g}]")
        if isinstance(one, Expected):
            conditions: list[Part] = [Value(T) for T in one.when]
            return Value(one.type), below(*conditions), p
        judged = [
            beside(Value(sit), Text(":"), Value(T))
            for sit, T in ((one.sit, one.type), *one.when)
        ]
        return judged[0], below(*judged[1:]), p

    return table(("judgement", "given", "p"), theory.givens, row)


def _strategies_shown(theory: Theory) -> Part:
    return table(
        ("name", "strategy"),
        theory.strategies.items(),
        lambda it: (Text(it[0], "strong"), Text(str(it[1]), "code")),
    )


def _games_shown(theory: Theory) -> Part:
    def row(one: Opening) -> tuple[Part, ...]:
        fields: list[tuple[str, Part]] = [
            ("states", Value(one.type)),
            ("start", Value(one.start)),
            ("order", Text(str(one.algorithm), "code")),
        ]
        return Text(one.name, "strong"), Fields(tuple(fields))

    return table(("game", ""), theory.openings.values(), row)


# --- reading --------------------------------------------------------------------------


def load(
    path: str | os.PathLike[str], *, allow: Iterable[str | os.PathLike[str]] = ()
) -> Theory:
    """The theory in a file; raises `TTRError` if it cannot be read.

    An `import` in it is relative to the file, and may not lead out of the file's folder
    but into the folders that `allow` names.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "kennel.ttr")
    ...     _ = file.write_text("basic Ind\\nPet := [x : Ind]")
    ...     print(load(file).Pet)
    [x : Ind]
    """
    if not isinstance(path, str | os.PathLike):
        raise TTRError(f"load takes the path of a file, found {kind_of(path)}")
    return theory_of_file(FilePath(path), Consent.of(allow))


def theory_of_text(
    text: str, source: str = "<text>", consent: Consent | None = None
) -> Theory:
    """The theory that a text declares; an import is relative to the working directory.

    It may import from the working directory, or from where `consent` allows. Raises the
    mistake in it, or `MistakesError` if there are several.
    """
    return theory_of_draft(draft_of_text(text, source, consent))


def theory_of_file(
    path: FilePath, consent: Consent = OWN_FOLDER, read: ReadText | None = None
) -> Theory:
    """The theory in a file; raises `UnreadableError`, the mistake in it, or
    `MistakesError`.

    It, and what it imports, may import from its folder, or from where the user's
    consent allows. `read` reads the text of each file, if they are not read from disk.
    """
    return theory_of_draft(draft_of_file(path, consent, read))


def theory_of_draft(draft: Draft) -> Theory:
    """The theory read so far; what is added to the draft later does not change it."""
    return Theory(
        axioms=tuple(draft.axioms),
        exclusions=tuple(draft.exclusions),
        opened=frozenset(draft.opened),
        givens=tuple(draft.givens),
        definitions=dict(draft.definitions),
        basics=dict(draft.basics),
        predicates=dict(draft.predicates),
        objects=frozenset(draft.objects),
        checks=tuple(draft.checks),
        source=draft.source,
        rules=dict(draft.rules),
        strategies=dict(draft.strategies),
        openings=dict(draft.openings),
        declared=dict(draft.declared),
        written=dict(draft.written),
        defined_at=dict(draft.defined_at),
        spelling=spelling_of(draft.written.values()),
    )
