"""Reads update strategies: `strategy name := first(a, maybe(repeat(b, 9)))`.

A strategy is written like an application: a name alone is a rule or a strategy, and a
name before a bracket says how the parts in the bracket are combined.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NoReturn

from ttr.errors import TTRError, suggestion
from ttr.notation.names import is_declared
from ttr.notation.reader import Reader
from ttr.notation.scanning import DEPTH
from ttr.notation.syntax_errors import excerpt
from ttr.notation.syntax_trees import Application, Literal, Name, Part, Term, inside
from ttr.updates.update_strategies import (
    Algorithm,
    all_,
    by_class,
    first,
    maybe,
    parts_of,
    repeat,
    seq,
)

_SEVERAL: Mapping[str, Callable[..., Algorithm]] = {
    "first": first,
    "all": all_,
    "seq": seq,
}
"""Words before rules and strategies in brackets."""

COMBINING = (*_SEVERAL, "maybe", "repeat", "by_class")
"""All words that combine rules and strategies."""

_PARTS = 10_000
"""The largest number of parts of a strategy, each counted as often as it is named."""

_MADE_OF = "a strategy is made of rules and strategies"


def read_strategy(term: Term, reader: Reader) -> Algorithm:
    """The rule or strategy that a term stands for; raises `NotationError`."""
    found = _StrategyReader(reader).algorithm(term)
    too_large = _why_too_large(found)
    if too_large:
        reader.refuse(term, too_large)
    return found


def _why_too_large(algorithm: Algorithm) -> str:
    """Why a strategy is too large; empty if it is not."""
    waiting, count = [(algorithm, 1)], 0
    while waiting:
        one, depth = waiting.pop()
        count += 1
        if depth > DEPTH:
            return f"strategies nest at most {DEPTH} deep, with those that they name"
        if count > _PARTS:
            return f"a strategy has at most {_PARTS:,} parts, with those that it names"
        waiting += [(part, depth + 1) for part in parts_of(one)]
    return ""


def kinds_gathered(part: Part) -> frozenset[str]:
    """The kinds of rules that `by_class` gathers in a part of a text."""
    return frozenset(
        arg.labels[0]
        for term in inside(part)
        if isinstance(term, Application) and _is_by_class(term.head)
        for arg in term.args
        if isinstance(arg, Name)
    )


def _is_by_class(head: Term) -> bool:
    return isinstance(head, Name) and head.labels == ("by_class",)


@dataclass(frozen=True)
class _StrategyReader:
    """Reads strategies."""

    reader: Reader

    def algorithm(self, term: Term) -> Algorithm:
        match term:
            case Name(_, _, (name,), None):
                return self._rule_or_strategy(term, name)
            case Application(_, _, Name(_, _, (word,), None), args):
                return self._combination_at(term, word, args)
        found = self.reader.text_of(term)
        self.reader.refuse(term, f"{_MADE_OF}, found {found}", _way_out())

    # --- names ---

    def _rule_or_strategy(self, term: Name, name: str) -> Algorithm:
        theory = self.reader.theory
        for known in (theory.rules, theory.strategies):
            if name in known:
                return known[name]
        if is_declared(theory, name):
            self.reader.refuse(term, f"{_MADE_OF}, and {name} is neither")
        if name in self.reader.later:
            self.reader.refuse_too_early(term, name)
        known_names = [*theory.rules, *theory.strategies]
        self.reader.refuse(
            term,
            f"no rule or strategy is called {excerpt(name)}",
            suggestion(name, known_names)
            or f"declare it first: rule {name}(s : S) := …",
        )

    # --- words before a bracket ---

    def _combination_at(
        self, term: Application, word: str, args: tuple[Term, ...]
    ) -> Algorithm:
        try:
            return self._combination(term, word, args)
        except TTRError as error:
            raise error.at(self.reader.source.span(term)) from None

    def _combination(
        self, term: Application, word: str, args: tuple[Term, ...]
    ) -> Algorithm:
        if word in _SEVERAL:
            return self._combine_several(term, word, args)
        match word, args:
            case "maybe", (part,):
                return maybe(self.algorithm(part))
            case "repeat", (part, *bounds):
                return self._repeat(part, bounds)
            case "by_class", (_, *_):
                return self._by_class(args)
            case (("maybe" | "repeat" | "by_class"), _):
                self._refuse_count(term, word, len(args))
        self._refuse_word(term, word)

    def _combine_several(
        self, term: Application, word: str, args: tuple[Term, ...]
    ) -> Algorithm:
        if not args:
            self._refuse_count(term, word, 0)
        parts: list[Algorithm] = []
        for arg in args:
            part = self.algorithm(arg)
            if word == "first" and any(part is one for one in parts):
                self.reader.refuse(
                    arg,
                    f"{self.reader.text_of(arg)} is in this {word} twice: its second "
                    "place is never reached",
                )
            parts.append(part)
        return _SEVERAL[word](*parts)

    def _repeat(self, part: Term, bounds: list[Term]) -> Algorithm:
        """repeat(a), with a number of times, a path to what gets smaller, or both."""
        times: int | None = None
        measure: str | None = None
        for bound in bounds:
            match bound:
                case Literal(_, _, int(count)) if count > 0 and times is None:
                    times = count
                case Name(_, _, labels, None) if measure is None:
                    measure = ".".join(labels)
                case _:
                    found = self.reader.text_of(bound)
                    self.reader.refuse(
                        bound,
                        "repeat takes how often at most, a number from 1, or the path "
                        f"of what gets smaller, found {found}",
                        "write repeat(a, 10) or repeat(a, shared.qud)",
                    )
        return repeat(self.algorithm(part), times=times, measure=measure)

    def _by_class(self, args: tuple[Term, ...]) -> Algorithm:
        """The rules of these kinds that have been declared so far."""
        kinds: list[str] = []
        for arg in args:
            match arg:
                case Name(_, _, (kind,), None):
                    self._check_kind(arg, kind, kinds)
                    kinds.append(kind)
                case _:
                    found = self.reader.text_of(arg)
                    self.reader.refuse(
                        arg, f"by_class takes kinds of rules, found {found}"
                    )
        rules = self.reader.theory.rules.values()
        return by_class(*[one for one in rules if one.kind in kinds], order=kinds)

    def _check_kind(self, arg: Term, kind: str, before: list[str]) -> None:
        if kind in before:
            self.reader.refuse(arg, f"the kind {kind} is there twice")
        known = {one.kind for one in self.reader.theory.rules.values()}
        if kind in known:
            return
        self.reader.refuse(
            arg,
            f"no rule is of the kind {excerpt(kind)}",
            suggestion(kind, known - {""})
            or f"a rule has its kind after its brackets: rule a(s : S) of {kind} := …",
        )

    # --- errors ---

    def _refuse_count(self, term: Application, word: str, found: int) -> NoReturn:
        wanted = {
            "maybe": "one rule or strategy",
            "repeat": "a rule or strategy",
            "by_class": "kinds of rules",
        }.get(word, "rules and strategies")
        has = f"has {found}" if found else "has none"
        self.reader.refuse(term, f"{word} takes {wanted}, but {has}")

    def _refuse_word(self, term: Application, word: str) -> NoReturn:
        if word == "ask":
            self.reader.refuse(
                term.head,
                "ask needs a function that chooses, and is built in Python",
                "from ttr.updates import ask",
            )
        theory = self.reader.theory
        if word in theory.rules or word in theory.strategies:
            self.reader.refuse(
                term, f"{word} stands alone in a strategy, without brackets"
            )
        self.reader.refuse(
            term.head,
            f"no way to combine rules is called {excerpt(word)}",
            suggestion(word, COMBINING) or _way_out(),
        )


def _way_out() -> str:
    return f"rules are combined by {', '.join(COMBINING[:-1])} and {COMBINING[-1]}"
