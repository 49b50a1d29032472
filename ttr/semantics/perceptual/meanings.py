r"""Meanings with classifiers inside: {params, bg, clf, interp}, ordinary records.

A situation of the background type `bg` has a percept in it. The classifier `clf` says
by the parameters `params` how far the percept is what the word is said of, and
`interp` is the type that the situation then gets. To learn is to get a meaning with
other parameters; the old one stays. Source: Larsson 2013.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

from ttr.building.functions import fix
from ttr.errors import TTRError, Undecided, Unsupported
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model, as_model
from ttr.probability import UNKNOWN, Degree, degree
from ttr.semantics.perceptual.classifiers import Classifier, Method
from ttr.semantics.perceptual.interpretations import claim_of
from ttr.semantics.perceptual.meaning_form import check_record
from ttr.semantics.perceptual.vectors import RealVector, is_vector
from ttr.types.objects import Unresolved
from ttr.types.paths import occurring
from ttr.types.printing import notation
from ttr.types.substitution import grounded
from ttr.types.syntax import (
    BOUND,
    Function,
    Negation,
    Object,
    Path,
    Pred,
    PType,
    Record,
    RecordType,
    TypeNode,
    identity,
    record,
)

__all__ = ["Meaning", "as_meaning", "meaning"]


def meaning(
    interp: Function,
    method: Method,
    params: Record | Mapping[str, object],
    *,
    of: str | tuple[str, ...],
    through: Callable[..., object] | None = None,
) -> Meaning:
    r"""The meaning {params, bg, clf, interp} of a word, where bg is interp's domain.

    `of` is the path of the percept in a situation, or several; `through` makes the
    percept of what is there, if that is a handle.

    >>> from ttr.building.constructors import fun, rectype
    >>> from ttr.semantics.perceptual.perceptron import Perceptron
    >>> from ttr.types.syntax import Ind, outer
    >>> bg = rectype(foo=Ind, spkr=Ind, pos=RealVector)
    >>> to_the_right = rectype(c=Pred("right", Ind)(outer.r.foo))
    >>> params = record(w=[0.8, 0.01], t=0.09)
    >>> right = meaning(fun(r=bg)(to_the_right), Perceptron(), params, of="pos")
    >>> s = record(foo="o1", spkr="a", pos=[0.9, 0.1])
    >>> round(right.score(s), 3), str(right.classify(s))
    (0.721, 'right(o1)')
    >>> print(right.rejected(s).params)
    {t = 1.09, w = [-0.09999999999999998, -0.09000000000000001]}
    """
    clf = Classifier(method, (of,) if isinstance(of, str) else of, through)
    bg = interp.domain if isinstance(interp, Function) else interp
    return Meaning(record(params=params, bg=bg, clf=clf, interp=interp))


@dataclass(frozen=True)
class Meaning:
    """A perceptual meaning: a view of the record {params, bg, clf, interp}.

    Meanings are equal when their records are. Raises `TTRError` for a record that is
    no such meaning.
    """

    record: Record

    def __post_init__(self) -> None:
        check_record(self.record)

    def __str__(self) -> str:
        return str(self.record)

    def _repr_html_(self) -> str:
        return self.record._repr_html_()

    def _repr_latex_(self) -> str:
        return self.record._repr_latex_()

    # --- what it is made of ---

    @property
    def params(self) -> Record:
        """The parameters: what learning changes."""
        return cast(Record, self.record._fields["params"])

    @property
    def bg(self) -> RecordType:
        """The background: the type of the situations that it can be asked of."""
        return cast(RecordType, self.record._fields["bg"])

    @property
    def clf(self) -> Classifier:
        """The classifier: its method, and where its percept is."""
        return cast(Classifier, self.record._fields["clf"])

    @property
    def interp(self) -> Function:
        """The interpretation: from a situation to the type that the word gives it."""
        return cast(Function, self.record._fields["interp"])

    @cached_property
    def claim(self) -> PType:
        """The ptype in the interpretation, with paths into the situation."""
        return claim_of(self.interp)[1]

    @property
    def predicate(self) -> Pred:
        """The word's own predicate."""
        return self.claim.pred

    @property
    def type(self) -> RecordType:
        """The type of the situations in which the word holds: bg and interp in one.

        The merge of such types is the type in which all their classifiers judge.
        """
        return fix(self.interp)

    # --- what it says of a situation ---

    def degree(self, r: Record, /) -> Degree:
        """How far the word holds of what is perceived in a situation.

        [0, 1] where nothing can be seen. Raises `TTRError` where there is no percept,
        and where the classifier fails or answers with what is no degree.
        """
        return self._of_percept(self._percept(r))

    def score(self, r: Record, /) -> float:
        """What the method sets against its threshold, if it has one."""
        method = self.clf.method
        if not hasattr(method, "score"):
            raise Unsupported(f"{self._word}: {method} has degrees, but no score")
        x = self._percept(r)
        if x is None:
            raise Undecided(f"{self._word}: nothing can be seen in {notation(r)}")
        return float(self._asked(method.score, x))

    def classify(self, r: Record, /) -> TypeNode:
        """The type that the situation gets: that the word holds, or that it does not.

        It holds if its degree is at least a half. Raises `Undecided` where that is not
        known.
        """
        p = self.degree(r)
        if p.lo < 0.5 <= p.hi:
            raise Undecided(
                f"{self._word}: {notation(r)} may be so or not, with the degree {p}"
            )
        claim: PType = self._grounded(self.claim, ({}, {BOUND: r}))
        return claim if p.lo >= 0.5 else Negation(claim)

    def content(self, r: Record, /) -> TypeNode:
        """interp(r): what the word, said in the situation, means there."""
        content: TypeNode = self._grounded(self.interp.body, ({BOUND: r},))
        return content

    # --- what it learns from feedback ---

    def confirmed(self, r: Record, /) -> Meaning:
        """The meaning after the word was rightly said in the situation.

        Only parameters change, as the method says; if none does, it is this meaning.
        Raises `TTRError` where nothing can be seen in it, and where the method fails.
        """
        return self._taught(self.clf.method.confirmed, r)

    def rejected(self, r: Record, /) -> Meaning:
        """The meaning after the word was wrongly said in the situation.

        As for `confirmed`; and `Unsupported` where the method has no use for it.
        """
        return self._taught(self.clf.method.rejected, r)

    def with_params(self, params: Record | Mapping[str, object], /) -> Meaning:
        """The meaning with these parameters in place of its own."""
        return Meaning(record({**self.record._fields, "params": params}))

    # --- in a model ---

    def witness(self, *situations: Record) -> Callable[..., Degree]:
        """The witness function of the word's predicate.

        Where all of the percept is among the arguments of the predicate, it is seen
        there; else in the situations, the last of which with these arguments counts.
        The degree of what was in none of them is [0, 1].
        """
        seen = {self._key(r): self._percept(r) for r in situations}
        paths = [_path(arg) for arg in self.claim.args]
        needed = [tuple(path.split(".")) for path in self.clf.of]
        places = [paths.index(path) for path in needed if path in paths]

        def asked(*args: Object) -> Degree:
            if len(places) == len(needed):
                return self._of_percept(self._sensed(*[args[i] for i in places]))
            return self._of_percept(seen.get(identity(args)))

        return asked

    def in_model(self, M: Model, /, *situations: Record) -> Model:
        """The model in which the meaning judges what its predicate holds of."""
        M = as_model(M)
        if any(part is RealVector for part in occurring([self.bg])):
            M = M.witnessed(RealVector, by=is_vector)
        return M.witnessed(self.predicate, by=self.witness(*situations))

    def judge(self, M: Model, r: Record, /) -> Judgement:
        """The judgement that the situation, with what is perceived, is of `type`."""
        return self.in_model(M, r).perceive(r, self.type)

    # --- asking the classifier ---

    @property
    def _word(self) -> str:
        return self.predicate.name

    def _percept(self, r: Record) -> Object | None:
        if not isinstance(r, Record):
            raise TTRError(f"{self._word} is said of a record, found {notation(r)}")
        try:
            return self.clf.percept(r)
        except TTRError as error:
            raise self._named(error) from None

    def _sensed(self, *found: Object) -> Object | None:
        try:
            return self.clf.sensed(*found)
        except TTRError as error:
            raise self._named(error) from None

    def _of_percept(self, x: Object | None) -> Degree:
        if x is None:
            return UNKNOWN
        found = self._asked(self.clf.method.degree, x)
        try:
            return degree(found, f"{self._word}: a degree")
        except TTRError as error:
            raise self._named(error) from None

    def _taught(self, step: Callable[[Record, Object], Record], r: Record) -> Meaning:
        x = self._percept(r)
        if x is None:
            raise TTRError(
                f"{self._word}: nothing can be seen in {notation(r)} to learn from"
            )
        params = self._asked(step, x)
        return self if params is self.params else self.with_params(params)

    def _asked(self, ask: Callable[[Record, Object], Any], x: Object) -> Any:
        """What the method answers; its errors are told as this word's."""
        try:
            return ask(self.params, x)
        except TTRError as error:
            raise self._named(error) from None
        except Exception as error:
            raise TTRError(
                f"{self._word}: {self.clf.method} failed on {notation(x)}: "
                f"{type(error).__name__}: {error}"
            ) from error

    def _named(self, error: TTRError) -> TTRError:
        """The error, told as one of this word."""
        if error.message.startswith(f"{self._word}: "):
            return error
        message = f"{self._word}: {error.message}"
        return error.__class__(message, hint=error.hint)

    def _grounded(self, value: Object, around: tuple[Mapping[str, Object], ...]) -> Any:
        try:
            return grounded(value, around)
        except Unresolved as error:
            raise self._named(TTRError(error.message)) from None

    def _key(self, r: Record) -> object:
        """The arguments that the word's predicate has in a situation."""
        args = self._grounded(self.claim.args, ({}, {BOUND: r}))
        return identity(args)


def as_meaning(value: object) -> Meaning:
    """The meaning itself, or that which a record is; `TTRError` for what is none."""
    return value if isinstance(value, Meaning) else Meaning(cast(Record, value))


def _path(arg: Object) -> tuple[str, ...] | None:
    """The path into the situation that an argument is, else None."""
    return arg.labels[1:] if isinstance(arg, Path) else None
