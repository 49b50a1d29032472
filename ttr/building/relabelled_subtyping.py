"""Subtyping up to relabelling: is S below T, if T's labels are called otherwise?

Two agents who have seen the same may have stored it under different labels. S ⊑ T up to
relabelling if some relabelling η of T makes S ⊑ [T]_η. Source: Cooper 2023, on
attitudes.

The labels that other fields depend on are chosen one by one, with what depends on them
checked as soon as it can be; what nothing depends on is then matched all at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import islice

from ttr.building.field_addresses import Address, format_address, to_absolute
from ttr.building.relabelling import nested_fields, relabel
from ttr.computing.case_analysis import cases_or_whole
from ttr.computing.generic_witness import ITSELF, step
from ttr.computing.normalisation import normal_type
from ttr.computing.prover import Prover
from ttr.computing.subtyping import Answer, is_decided, subtype
from ttr.errors import IllFormedError, TooLargeError
from ttr.safety.budgets import spend, within_budget
from ttr.signature.axioms import supertype_set
from ttr.signature.signature import Signature, head, signature_of
from ttr.types.objects import Path
from ttr.types.paths import free_paths, replace_paths, subterms
from ttr.types.printing import notation
from ttr.types.syntax import Basic, PType, RecordType, TypeNode, as_type


@dataclass(frozen=True, eq=False, repr=False)
class RelabelledAnswer(Answer):
    """An answer on subtyping up to relabelling, with the relabelling if it is yes.

    `relabelling` has the new names of those labels of T that change; a label inside a
    nested record type is named by its path. It is None unless the answer is yes.

    >>> from ttr import Ind, rectype
    >>> answer = subtype_up_to_relabelling(rectype(y=Ind), rectype(x=Ind))
    >>> answer.yes, answer.relabelling
    (True, {'x': 'y'})
    """

    relabelling: Mapping[str, str] | None = None

    def __reduce__(self) -> tuple[object, ...]:
        names = None if self.relabelling is None else dict(self.relabelling)
        return RelabelledAnswer, (self.verdict, self.why, None, names)


def _left_open(error: TooLargeError, *_: object, **__: object) -> RelabelledAnswer:
    """The answer where the budget ended."""
    return RelabelledAnswer("unknown", error.message)


@within_budget(otherwise=_left_open)
def subtype_up_to_relabelling(
    S: TypeNode, T: TypeNode, /, theory: Signature | None = None
) -> RelabelledAnswer:
    """Is S a subtype of T for some relabelling of T?

    The answer is yes with a relabelling η such that `S <= relabel(T, η)`, where T is
    what it computes to; labels that can stay the same do. It is no where every
    relabelling is refuted. A type that is no record type has only one. Raises
    `IllFormedError` for what is no type. Source: Cooper 2023, on attitudes.

    >>> from ttr import Ind, Pred, rectype, this
    >>> dog, cat = Pred("dog", Ind), Pred("cat", Ind)
    >>> S = rectype(x=Ind, c=dog(this.x), y=Ind, e=cat(this.y))
    >>> answer = subtype_up_to_relabelling(S, rectype(x=Ind, c=cat(this.x)))
    >>> print(answer)
    yes: with x as y, c as e
    >>> answer.relabelling
    {'x': 'y', 'c': 'e'}
    >>> print(subtype_up_to_relabelling(rectype(x=Ind), rectype(x=Ind, c=cat(this.x))))
    no: with x as x, no field of [x : Ind] can be c : cat(x)
    """
    S, T, theory = as_type(S), as_type(T), signature_of(theory)
    S, T = normal_type(S, theory), normal_type(T, theory)
    same = subtype(S, T, theory)
    if same.yes:
        return RelabelledAnswer("yes", lambda: same.why, relabelling={})
    if not isinstance(T, RecordType):
        return _without_relabelling(T, same)
    if free_paths(S) or free_paths(T):
        return RelabelledAnswer("unknown", lambda: f"paths lead out of {S} or {T}")
    return _Search(S, T, theory).answer()


def _without_relabelling(T: TypeNode, same: Answer) -> RelabelledAnswer:
    """The answer for what is no record type, but may have some inside."""
    if same.no and _has_labels(T):
        return RelabelledAnswer("unknown", lambda: f"no labels are changed inside {T}")
    return RelabelledAnswer(same.verdict, lambda: same.why)


def _has_labels(T: TypeNode) -> bool:
    """Has a type labels that could be renamed, in itself or in its parts?"""
    return next(nested_fields(T), None) is not None


# --- the fields of T ------------------------------------------------------------------

_Names = Mapping[Address, str]
"""New names of labels, by their addresses."""


def _rename(labels: Address, names: _Names) -> Address:
    """An address in the new names."""
    found = (names.get(labels[: n + 1], label) for n, label in enumerate(labels))
    return tuple(found)


@dataclass(frozen=True)
class _Field:
    """A field of T or of a record type inside it: its address and its type.

    `needs` are the addresses of fields that its type depends on.
    """

    at: Address
    type: TypeNode
    needs: frozenset[Address]
    scopes: tuple[frozenset[str], ...]

    @property
    def holds_fields(self) -> bool:
        """Is it a record type whose fields may be called otherwise, too?"""
        return isinstance(self.type, RecordType) and bool(self.type.fields)

    def type_in(self, names: _Names) -> TypeNode:
        """The type, with places in a witness of S in place of paths."""

        def place(path: Path) -> Path:
            labels = to_absolute(path, self.at[:-1]).labels
            return Path(0, (*ITSELF.labels, *_rename(labels, names)))

        found: TypeNode = replace_paths(self.type, place)
        return found

    def __str__(self) -> str:
        return f"{format_address(self.at)} : {notation(self.type, self.scopes)}"


def _list_fields(
    T: RecordType, at: Address = (), around: tuple[frozenset[str], ...] = ()
) -> Iterator[_Field]:
    """The fields of T and of record types inside it, in the order of dependency."""
    scopes = (frozenset(T.labels), *around)
    for label, F in T.fields:
        spend()
        paths = [to_absolute(path, at).labels for path in free_paths(F)]
        needs = {labels[:n] for labels in paths for n in range(1, len(labels) + 1)}
        here = (*at, label)
        yield _Field(here, F, frozenset(needs), scopes)
        if isinstance(F, RecordType):
            yield from _list_fields(F, here, scopes)


# --- the search -----------------------------------------------------------------------

_TRIED = 200
"""How many relabellings are refuted one by one, where the rules do not decide."""


class _Search:
    """The search for a relabelling of T for which S is below it."""

    def __init__(self, S: TypeNode, T: RecordType, theory: Signature) -> None:
        self._S, self._T, self._theory = S, T, theory
        provers = [Prover.for_type(case, theory) for case in cases_or_whole(S)]
        self._provers = [one for one in provers if not one.is_impossible]
        self._fields = list(_list_fields(T))
        needed = frozenset[Address]().union(*(one.needs for one in self._fields))
        self._chosen = [f for f in self._fields if f.holds_fields or f.at in needed]
        self._order = {one.at: n for n, one in enumerate(self._chosen)}
        self._waiting = self._sort_by_last_need()
        self._fitting: dict[object, tuple[str, ...]] = {}
        self._records: dict[Path, _LabelIndex] = {}
        self._failure = (-2, "")
        self._open = ""

    def answer(self) -> RelabelledAnswer:
        """Yes with the first relabelling that is found, no if there is none."""
        for names in self._relabellings():
            found = self._try(names)
            if found is not None:
                return found
        if any(_has_labels(one.type) for one in self._fields if not one.holds_fields):
            self._open = f"labels inside other types than record types in {self._T}"
        if self._open:
            return RelabelledAnswer("unknown", self._open)
        if all(is_decided(prover, self._T) for prover in self._provers):
            return RelabelledAnswer("no", self._failure[1])
        return self._refute_each()

    def _try(self, names: _Names) -> RelabelledAnswer | None:
        """The answer yes with this relabelling, or None."""
        changed = {
            format_address(one.at): names[one.at]
            for one in self._fields
            if names[one.at] != one.at[-1]
        }
        try:
            renamed = relabel(self._T, changed)
        except IllFormedError:
            return None
        found = subtype(self._S, renamed, self._theory)
        if found.yes:
            why = _describe(self._fields, names)
            return RelabelledAnswer("yes", why, relabelling=changed)
        if found.unknown:
            self._open = self._open or found.why
        return None

    # --- what others depend on ---

    def _sort_by_last_need(self) -> dict[int, list[_Field]]:
        """The fields that are checked after each choice: the last that they wait for.

        That is a choice before their own, or on a circle of paths one after it.
        """
        waiting: dict[int, list[_Field]] = {}
        for one in self._fields:
            before = [at for at in (*one.needs, one.at[:-1]) if at in self._order]
            last = max((self._order[at] for at in before), default=-1)
            if one.at not in self._order or last > self._order[one.at]:
                waiting.setdefault(last, []).append(one)
        return waiting

    def _relabellings(self) -> Iterator[_Names]:
        """The names for all labels, one for each way to name what others depend on."""
        stack: list[Iterator[dict[Address, str]]] = [self._extend_if_possible(-1, {})]
        while stack:
            names = next(stack[-1], None)
            if names is None:
                stack.pop()
            elif len(names) < len(self._chosen):
                stack.append(self._choices(len(names), names))
            else:
                found = self._match_leaves(names)
                if found is not None:
                    yield found

    def _choices(
        self, number: int, names: dict[Address, str]
    ) -> Iterator[dict[Address, str]]:
        one = self._chosen[number]
        is_early = any(self._order.get(at, -1) > number for at in one.needs)
        fitting = self._unused_labels(one, names, untested=is_early)
        if not fitting:
            self._note_failure(number, one, names)
        for label in fitting:
            spend(1 + len(names) // 4)
            yield from self._extend_if_possible(number, {**names, one.at: label})

    def _extend_if_possible(
        self, number: int, names: dict[Address, str]
    ) -> Iterator[dict[Address, str]]:
        """The names, if every field that waits for the last of them still fits."""
        for one in self._waiting.get(number, ()):
            chosen = names.get(one.at)
            fits = (
                self._unused_labels(one, names)
                if chosen is None
                else chosen in self._fit(one, names)
            )
            if not fits:
                self._note_failure(number, one, names)
                return
        yield names

    def _unused_labels(
        self, one: _Field, names: _Names, untested: bool = False
    ) -> list[str]:
        """The labels that a field may have besides those that others have."""
        used = _used_names(names, one.at[:-1])
        fitting = self._fit(one, names, untested)
        return [label for label in fitting if label not in used]

    def _fit(
        self, one: _Field, names: _Names, untested: bool = False
    ) -> tuple[str, ...]:
        """The labels in S that a field may have, its own first.

        With `untested` all labels: what the field depends on is not yet named.
        """
        place = Path(0, (*ITSELF.labels, *_rename(one.at[:-1], names)))
        untested = untested or one.holds_fields
        T = None if untested else one.type_in(names)
        key = place, T, one.at[-1]
        if key not in self._fitting:
            if place not in self._records:
                self._records[place] = _LabelIndex(self._provers, place)
            record = self._records[place]
            may = record.labels if T is None else record.that_may_be(T)
            own = [one.at[-1]] if one.at[-1] in may else []
            every: Iterable[str] = dict.fromkeys((*own, *may))
            if T is not None:
                every = filter(partial(self._is, place, T), every)
            self._fitting[key] = tuple(every)
        return self._fitting[key]

    def _is(self, place: Path, T: TypeNode, label: str) -> bool:
        inside = step(place, label)
        return all(one.prove(inside, T).yes for one in self._provers)

    # --- what nothing depends on ---

    def _match_leaves(self, names: dict[Address, str]) -> dict[Address, str] | None:
        """The names with one for each leaf, no two alike in a record; else None."""
        found = dict(names)
        for around in dict.fromkeys(one.at[:-1] for one in self._fields):
            inside = [
                one
                for one in self._fields
                if one.at[:-1] == around and one.at not in names
            ]
            matched = _match([self._unused_labels(leaf, names) for leaf in inside])
            if matched is None:
                last = len(self._chosen)
                listed = ", ".join(format_address(one.at) for one in inside)
                why = f"{self._S} has too few fields that can be {listed}"
                self._failure = max(self._failure, (last, why), key=lambda it: it[0])
                return None
            found |= {
                leaf.at: label for leaf, label in zip(inside, matched, strict=True)
            }
        return found

    # --- why not ---

    def _note_failure(self, number: int, one: _Field, names: _Names) -> None:
        """Remember what did not fit, if it came further than what failed before."""
        if number <= self._failure[0]:
            return
        before = [it for it in self._fields if it.at in one.needs and it.at in names]
        given = f"{_describe(before, names)}, " if before else ""
        self._failure = number, f"{given}no field of {self._S} can be {one}"

    def _refute_each(self) -> RelabelledAnswer:
        """No if a counterexample to each relabelling is found."""
        every = list(islice(self._all_relabellings(), _TRIED + 1))
        if len(every) > _TRIED:
            return RelabelledAnswer("unknown", self._failure[1])
        for names in every:
            try:
                answer = subtype(self._S, relabel(self._T, names), self._theory)
            except IllFormedError:
                continue
            if not answer.no:
                return RelabelledAnswer("unknown", answer.why)
        return RelabelledAnswer("no", self._failure[1])

    def _all_relabellings(self) -> Iterator[dict[str, str]]:
        """Every relabelling, where those that differ in labels unknown to S are one."""
        kinds = [one for one in subterms([self._S]) if isinstance(one, RecordType)]
        known = sorted({label for one in kinds for label in one})
        stack: list[dict[Address, str]] = [{}]
        while stack:
            spend()
            names = stack.pop()
            if len(names) == len(self._fields):
                yield {format_address(at): label for at, label in names.items()}
                continue
            at = self._fields[len(names)].at
            used = _used_names(names, at[:-1])
            new = f"{'_'.join(at)}_new"
            while new in known:
                new += "_"
            for label in (*known, new):
                if label not in used:
                    stack.append({**names, at: label})


class _LabelIndex:
    """The labels at a place in a witness of S, by the types that the fields are of.

    Of several cases of S, the labels are those that all have, the types those in one.
    """

    def __init__(self, provers: list[Prover], place: Path) -> None:
        first, *others = [one.labels_of(place) for one in provers]
        apart = [frozenset(one) for one in others]
        self.labels = [k for k in first if all(k in one for one in apart)]
        self._prover = provers[0]
        self._by_type: dict[TypeNode, list[str]] = {}
        self._compound: list[str] = []
        for label in self.labels:
            spend(2)
            known = self._prover.atoms_of(step(place, label))
            if known is None:
                self._compound.append(label)
            above = (supertype_set(T, self._prover.theory) for T in known or ())
            for T in frozenset[TypeNode](known or ()).union(*above):
                self._by_type.setdefault(T, []).append(label)

    def that_may_be(self, T: TypeNode) -> list[str]:
        """The labels whose fields may surely be of T, in order; no others are."""
        conditional = self._prover.theory.conditional_heads
        if not isinstance(T, Basic | PType) or head(T) in conditional:
            return self.labels
        exact = self._by_type.get(self._prover.witness.normalise(T), [])
        if not self._compound:
            return exact
        either = {*exact, *self._compound}
        return [label for label in self.labels if label in either]


def _used_names(names: _Names, around: Address) -> set[str]:
    """The names that are given to labels of one record type."""
    return {label for at, label in names.items() if at[:-1] == around}


def _describe(fields: Iterable[_Field], names: _Names) -> str:
    """The names in words: with x as y, c as e."""
    pairs = [f"{format_address(one.at)} as {names[one.at]}" for one in fields]
    return f"with {', '.join(pairs)}"


def _match(options: list[list[str]]) -> list[str] | None:
    """One of its options for each, all different; None if there is no such choice.

    The first option is taken where that leaves one for the others.

    >>> _match([["a", "b"], ["a"]]), _match([["a"], ["a"]])
    (['b', 'a'], None)
    """
    taken: dict[str, int] = {}
    for number in range(len(options)):
        came: dict[str, int] = {}
        waiting, free = [number], None
        while waiting and free is None:
            one = waiting.pop(0)
            for label in options[one]:
                spend()
                if label in came:
                    continue
                came[label] = one
                if label not in taken:
                    free = label
                    break
                waiting.append(taken[label])
        if free is None:
            return None
        while True:
            one = came[free]
            before = next((k for k, n in taken.items() if n == one), None)
            taken[free] = one
            if one == number:
                break
            assert before is not None
            free = before
    by_number = {n: label for label, n in taken.items()}
    return [by_number[n] for n in range(len(options))]
